"""Say how to run the same again."""

from __future__ import annotations

import json
import shlex
from pathlib import PurePath

import numpy as np

from reports import wording
from reports.content import Block, Code, Text
from reports.material import Material
from reports.reading.run import Plan

LINE = 100  # characters of a line of a command, which the page must not break


def blocks(material: Material) -> tuple[Block, ...]:
    """Give the commands to copy, and say what the commit does not hold."""
    plan = material.run.plan
    at = str((plan.merged or (plan.environment,))[0].get("commit") or "")
    lines = [*_checkout(at), "make .venv/ready"]
    for one in plan.merged:
        other = str(one.get("commit") or at)
        lines += [f"# on {' '.join(str(one['machine']).split())}", *_checkout(other if other != at else "")]
        lines.append(str(one["command"]))
        at = other
    reports = plan.command.startswith("firsthit report ")  # it joins runs by itself
    lines += [plan.command, *([] if reports else [f"firsthit report {shlex.quote(_folder(plan))}"])]
    told = (
        "Finished cells are reused, so that the run goes on where it stopped; --force runs all "
        "again. Times differ from machine to machine; answers on one device do not."
    )
    dirty = (
        "The run was made with uncommitted changes, which the commit does not hold."
        if any(one.get("dirty") for one in plan.merged or (plan.environment,))
        else ""
    )
    texts = filter(None, (told, dirty, _plugins(material), _config(plan)))
    return (Code("\n".join(line if line[0] == "#" else folded(line) for line in lines)), Text(" ".join(texts)))


def _checkout(commit: str) -> list[str]:
    return [f"git checkout {commit}"] if commit else []


def folded(command: str) -> str:
    """Fold a command at spaces into lines of at most LINE characters, each but the last ended by a backslash.

    A shell reads it as it reads the command. A word that is longer than a line has a line of its own.
    """
    words = [shlex.quote(word) for word in _words(command)]
    if len(command) <= LINE or not words:
        return command
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + len(word) + 3 > LINE:
            lines.append(f"    {word}")
        else:
            lines[-1] += f" {word}"
    return " \\\n".join(lines)


def _words(command: str) -> list[str]:
    """Return the words of a command; of one that no shell reads, what stands between its blanks."""
    try:
        return shlex.split(command)
    except ValueError:
        return command.split()


def _folder(plan: Plan) -> str:
    """Return the folder of the run that the plan's command makes: below the folder after --runs, if it names one."""
    words = _words(plan.command.replace("--runs=", "--runs ").replace("--output", "-o"))
    if plan.merged and "-o" in words[:-1]:
        return words[words.index("-o") + 1]
    runs = words[words.index("--runs") + 1] if "--runs" in words[:-1] else "runs"
    return str(PurePath(runs) / plan.name)


def _plugins(material: Material) -> str:
    """Name the methods from outside the project, which the commit does not hold, with the hashes of their files.

    "" where there are none.
    """
    plan = material.run.plan
    outside = {name: told["outside"] for name, told in plan.methods.items() if told.get("outside")}
    if not outside:
        taken = "--plugins" in _words(plan.command) and not any("outside" in told for told in plan.methods.values())
        return "Methods that --plugins adds are no part of the commit." if taken else ""
    each = [f"{name} from {folder}{_files(material, name)}" for name, folder in sorted(outside.items())]
    return (
        f"No part of the commit, which does not hold what lies outside the project: {wording.listed(each)}. To have "
        "the same results again, have the same files there."
    )


def _files(material: Material, method: str) -> str:
    """Write the files of a method and their hashes, as its rows store them; "" where none does."""
    for row in np.flatnonzero(material.frame["method"] == method):
        text = material.run.columns.at("identity", int(row))
        if text is not None:
            own = [f"{file} {found}" for file, found in (json.loads(text).get("method") or {}).items()]
            return f" ({', '.join(own)})" if own else ""
    return ""


def _config(plan: Plan) -> str:
    """Say that a config outside the project is no part of the commit; "" for a config inside the project."""
    if not PurePath(plan.config).is_absolute():
        return ""
    return f"The config {plan.config} is no part of the commit; the HTML page has its text, under “Failures, rerun”."
