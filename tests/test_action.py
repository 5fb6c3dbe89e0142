"""action.yml: what its steps run, with the environment that GitHub's runner gives them, and what is asked of it.

GitHub's runner is not here, so the shell text of each step is run by bash as the runner runs it. `python`, `firsthit`
and what installs packages are stand-ins that write down how they were called, and do nothing. What `firsthit` is called
with is held against the real command line.
"""

import os
import re
import shutil
import subprocess
import textwrap
from dataclasses import dataclass, field

import pytest

from harness import ROOT
from harness.cli import build_parser, main

ACTION = (ROOT / "action.yml").read_text()
STAND_IN = '#!/bin/sh\nfor word in "$0" "$@"; do echo "$word" >> "$CALLS"; done\necho >> "$CALLS"\nexit ${CODE:-0}\n'
EXPRESSION = re.compile(r"\$\{\{ (.+?) \}\}")


@dataclass
class Step:
    """A step of the action that runs shell text: its id or name, its environment, and the text."""

    name: str
    run: str
    environment: dict[str, str] = field(default_factory=dict)


def steps():
    """Read the steps that run something; the file is written so that a step begins with `    - `."""
    found = []
    for block in re.split(r"^    - ", ACTION, flags=re.M)[1:]:
        if "run: |\n" not in block:
            assert block.startswith("uses: actions/")
            continue
        head, text = block.split("      run: |\n")
        assert "shell: bash\n" in head
        environment = dict(re.findall(r"^        ([A-Z]+): (.+)$", head, re.M))
        found.append(Step(re.search("name: (.+)", block)[1], textwrap.dedent(text), environment))
    return found


def inputs(text=ACTION):
    """The inputs that the action declares, with their defaults; None where one is required."""
    block = text.split("\ninputs:\n")[1].split("\nruns:\n")[0]
    parts = re.split(r"^  ([a-z-]+):\n", block, flags=re.M)[1:]
    return {
        name: None if "required: true" in told else re.search("default: (.*)", told)[1].strip('"')
        for name, told in zip(parts[::2], parts[1::2], strict=True)
    }


@pytest.fixture
def runner(tmp_path):
    """A function that runs a step in a project of its own, and returns exit code, calls and outputs."""
    project, action, programs = (tmp_path / name for name in ("project", "action", "programs"))
    for folder in (project, programs):
        folder.mkdir()
    action.symlink_to(ROOT)
    for name in ("python", "firsthit", "apt-get", "sudo"):
        (programs / name).write_text(STAND_IN)
        (programs / name).chmod(0o755)
    (project / "configs").mkdir()
    (project / "configs/mine.toml").write_text("")
    git = ["git", "-C", str(project), "-c", "user.name=t", "-c", "user.email=t@example.org"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "first"]):
        subprocess.run([*git, *command], check=True)

    def run(step, code=0, **given):
        values = {"inputs.config": "configs/mine.toml", "steps.decides.outputs.name": "gate-mine"}
        values |= {f"inputs.{name}": EXPRESSION.sub("", default) for name, default in inputs().items() if default}
        values |= {name if "." in name else f"inputs.{name}": value for name, value in given.items()}
        told = {name: EXPRESSION.sub(lambda m: values.get(m[1], ""), text) for name, text in step.environment.items()}
        calls, outputs = tmp_path / "calls", tmp_path / "outputs"
        calls.write_text("")
        outputs.write_text("")
        environment = {
            **os.environ,
            **told,
            "PATH": f"{programs}:{os.environ['PATH']}",
            "GITHUB_ACTION_PATH": str(action),
            "GITHUB_OUTPUT": str(outputs),
            "RUNNER_OS": "Linux",
            "CALLS": str(calls),
            "CODE": str(code),
        }
        script = tmp_path / "step.sh"
        script.write_text(step.run)
        bash = ["bash", "--noprofile", "--norc", "-e", "-o", "pipefail", str(script)]
        ran = subprocess.run(bash, cwd=project, env=environment, capture_output=True, text=True, check=False)
        words = [call.splitlines() for call in calls.read_text().split("\n\n") if call.strip()]
        told_outputs = dict(line.split("=", 1) for line in outputs.read_text().splitlines())
        return ran.returncode, [[os.path.basename(w[0]), *w[1:]] for w in words], told_outputs  # noqa: PTH119

    run.project = project
    return run


def test_each_input_is_used_and_each_that_is_used_is_declared():
    assert set(re.findall(r"inputs\.([a-z-]+)", ACTION)) == inputs().keys()
    assert [step.name for step in steps()] == [
        "Install firsthit and drivers",
        "Name what decides the certified answers",
        "Gate",
    ]


def test_no_shell_text_holds_an_expression():
    """A pull request's title or branch in shell text would be run."""
    assert not [step.name for step in steps() if EXPRESSION.search(step.run)]


@pytest.mark.parametrize("workflow", [".github/workflows/gate.yml", "harness/commands/templates/gate.yml"])
def test_workflows_give_the_action_what_it_takes(workflow):
    text = (ROOT / workflow).read_text()
    uses = text.split("      - uses: ")[2]
    assert uses.startswith(("./", "$repository@main"))
    given = set(re.findall(r"(?:^ {10}|[{,] )([a-z-]+):", uses, re.M))
    required = {name for name, default in inputs().items() if default is None}
    assert required <= given <= inputs().keys()


def test_firsthit_is_installed_from_the_actions_own_files(runner):
    code, calls, _ = runner(steps()[0], code=0)
    assert code == 0
    action = runner.project.parent / "action"
    assert calls[0][:4] == ["python", "-m", "pip", "install"]
    assert calls[0][-1] == f"{action}[opengl,opencl,report]"
    assert str(action / "constraints.txt") in calls[0]
    assert any(call[:3] == ["python", "-m", "harness.cli"] for call in calls), "drivers.sh asks for devices"


def test_the_key_of_the_cache_follows_config_and_oracle(runner):
    first, again = (runner(steps()[1])[2] for _ in range(2))
    assert first == again and first["name"] == "gate-mine" and re.fullmatch("[0-9a-f]{16}", first["truth"])
    (runner.project / "configs/mine.toml").write_text("title = 'another'")
    assert runner(steps()[1])[2]["truth"] != first["truth"]
    other = runner.project.parent / "other"
    for name in ("harness", "surfaces"):
        shutil.copytree(ROOT / name, other / name)
    (other / "constraints.txt").write_text((ROOT / "constraints.txt").read_text())
    (other / "harness/oracle/__pycache__/left.pyc").parent.mkdir(exist_ok=True)
    (other / "harness/oracle/__pycache__/left.pyc").write_text("made by a run, with the time of that")
    (runner.project.parent / "action").unlink()
    (runner.project.parent / "action").symlink_to(other)
    (runner.project / "configs/mine.toml").write_text("")
    assert runner(steps()[1])[2]["truth"] == first["truth"]
    (other / "harness/oracle/slow.py").write_text("")
    assert runner(steps()[1])[2]["truth"] != first["truth"]


FILES = "--github --junit gate-mine/gate.xml --markdown gate-mine/gate.md --pictures gate-mine/pictures"


@pytest.mark.parametrize(
    ("baseline", "given", "expected"),
    [
        (True, {}, f"--plugins . gate configs/mine.toml {FILES}"),
        (True, {"plugins": ""}, f"gate configs/mine.toml {FILES}"),
        (
            True,
            {"device": "opencl:pocl opencl:intel", "plugins": "casters"},
            f"--plugins casters gate configs/mine.toml --device opencl:pocl --device opencl:intel {FILES}",
        ),
        (False, {"against": "HEAD"}, f"--plugins . gate configs/mine.toml --against HEAD {FILES}"),
        (
            True,
            {"against": "HEAD"},
            f"--plugins . gate configs/mine.toml --against HEAD --baseline configs/baselines/mine.toml {FILES}",
        ),
    ],
)
def test_the_gate_is_called_as_its_inputs_say(runner, baseline, given, expected):
    if baseline:
        (runner.project / "configs/baselines").mkdir()
        (runner.project / "configs/baselines/mine.toml").write_text("")
    for outcome in (0, 1, 3):
        code, calls, _ = runner(steps()[2], code=outcome, **given)
        assert code == outcome
        assert calls == [["firsthit", *expected.split()]]
    build_parser(expected.split()).parse_args(expected.split())


def test_a_reason_makes_a_new_baseline_that_is_uploaded(runner):
    (runner.project / "configs/baselines").mkdir()
    (runner.project / "configs/baselines/mine.toml").write_text("blessed")
    code, calls, _ = runner(steps()[2], bless="it $(touch injected) is so", against="HEAD")
    assert code == 0
    words = ["--plugins", ".", "bless", "configs/mine.toml", "--reason", "it $(touch injected) is so"]
    assert calls == [["firsthit", *words]]
    assert (runner.project / "gate-mine/mine.toml").read_text() == "blessed"
    build_parser(words).parse_args(words)


def test_a_commit_that_a_shallow_clone_lacks_is_fetched(runner):
    origin, project = runner.project.parent / "origin", runner.project
    shutil.copytree(project, origin)
    git = ["git", "-c", "user.name=t", "-c", "user.email=t@example.org", "-C"]
    (origin / "configs/mine.toml").write_text("title = 'second'")
    subprocess.run([*git, str(origin), "commit", "-qam", "second"], check=True)
    subprocess.run([*git, str(origin), "config", "uploadpack.allowAnySHA1InWant", "true"], check=True)
    subprocess.run([*git, str(project), "remote", "add", "origin", f"file://{origin}"], check=True)
    head = subprocess.run([*git, str(origin), "rev-parse", "HEAD"], capture_output=True, text=True, check=True)
    commit = head.stdout.strip()
    code, calls, _ = runner(steps()[2], against=commit)
    assert code == 0 and ["--against", commit] == calls[0][5:7]
    subprocess.run([*git, str(project), "cat-file", "-e", f"{commit}^{{commit}}"], check=True)


def test_a_pull_request_is_held_against_the_base_that_it_was_merged_into(runner, monkeypatch):
    """The event names an older one where the base went on since; a checkout of the branch itself has no other."""
    project = runner.project
    git = ["git", "-c", "user.name=t", "-c", "user.email=t@example.org", "-C", str(project)]

    def said(*arguments):
        return subprocess.run([*git, *arguments], check=True, capture_output=True, text=True).stdout.strip()

    old = said("rev-parse", "HEAD")
    said("checkout", "-qb", "request")
    said("commit", "-q", "--allow-empty", "-m", "requested")
    requested = said("rev-parse", "HEAD")
    said("checkout", "-q", "--detach", old)
    said("commit", "-q", "--allow-empty", "-m", "the base went on")
    base = said("rev-parse", "HEAD")
    said("merge", "-q", "--no-ff", "-m", "merged", "request")
    monkeypatch.setenv("GITHUB_EVENT_NAME", "pull_request")
    monkeypatch.setenv("GITHUB_SHA", said("rev-parse", "HEAD"))

    def against(**given):
        code, calls, _ = runner(steps()[2], **given)
        assert code == 0
        return calls[0][calls[0].index("--against") + 1]

    event = {"github.event.pull_request.base.sha": old}
    assert against(**event) == base
    assert against(**event, against="request") == "request"
    said("checkout", "-q", requested)
    assert against(**event) == old


def test_jobs_of_one_run_upload_under_names_of_their_own(runner):
    names = {
        runner(steps()[1], **{"device": device, "python-version": version})[2]["artifact"]
        for device in ("", "opencl:pocl", "opencl:pocl opengl:llvmpipe")
        for version in ("3.11", "3.12")
    }
    assert len(names) == 6 and all(re.fullmatch("[A-Za-z0-9._-]+", name) for name in names)


def test_a_new_projects_workflow_is_as_the_template(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "method", "mine"]) == 0
    text = (tmp_path / ".github/workflows/gate.yml").read_text()
    assert "with: { config: mine.toml, plugins: . }" in text and "$" not in text
