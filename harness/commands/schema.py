"""Offer `firsthit schema`: print the JSON schema of configs, for editors."""

from __future__ import annotations

import argparse
import json

from harness.commands import Add


def add_parsers(add: Add) -> None:
    parser = add(
        "schema",
        "firsthit schema > firsthit.json",
        "Print the JSON schema of configs (draft 2020-12), by which editors complete, explain and check them. Editors "
        "that use Taplo, such as VS Code with Even Better TOML, take it from a config's first line: "
        "`#:schema ./firsthit.json`.",
    )
    parser.set_defaults(run=_schema)


def _schema(_options: argparse.Namespace) -> int:
    from harness.experiment.schema import schema

    print(json.dumps(schema(), indent=2, ensure_ascii=False))
    return 0
