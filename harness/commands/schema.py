"""Offer `firsthit schema`: print the JSON schema of configs, for editors."""

from __future__ import annotations

import argparse
import json

from harness.commands import Add

ANSWERS = (  # of the commands that have --json; harness.commands.answers.table has their fields
    *("list surfaces", "list methods", "list configs", "list devices"),
    *("devices", "plan", "why", "gate", "history", "recommend", "verify"),
)


def add_parsers(add: Add) -> None:
    parser = add(
        "schema",
        "firsthit schema > firsthit.json",
        "Print the JSON schema of configs (draft 2020-12), by which editors complete, explain and check them. Editors "
        "that use Taplo, such as VS Code with Even Better TOML, take it from a config's first line: "
        "`#:schema ./firsthit.json`.",
    )
    help_ = f"print that of what a command answers with --json instead: {', '.join(ANSWERS)}"
    parser.add_argument("--of", choices=ANSWERS, metavar="COMMAND", help=help_)
    parser.set_defaults(run=_schema)


def _schema(options: argparse.Namespace) -> int:
    if options.of is None:
        from harness.experiment.schema import schema

        made = schema()
    else:
        from harness.commands.answers.table import answer_schema

        made = answer_schema(options.of)
    print(json.dumps(made, indent=2, ensure_ascii=False))
    return 0
