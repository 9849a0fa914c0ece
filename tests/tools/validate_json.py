#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates files against the JSON Schemas of lib/lightcal/records/schemas.

usage: validate_json.py SCHEMAS_DIR light|reading|session [--every-key] FILE...

A .toml file is seen as JSON (dates as ISO 8601 text); a .jsonl file line by line. Numbers that are
not finite and keys given twice are errors. With --every-key the files together must use every
property the schema declares, so that the schema holds no key the program does not know.
"""
import datetime
import json
import math
import pathlib
import sys
import tomllib

import jsonschema


def refuse_constant(word):
    raise ValueError(f"{word} is not JSON")


def table_without_twins(pairs):
    table = dict(pairs)
    if len(table) != len(pairs):
        raise ValueError("a key is given twice")
    return table


def parse_json(text):
    return json.loads(text, parse_constant=refuse_constant, object_pairs_hook=table_without_twins)


def json_view(value):
    if isinstance(value, dict):
        return {key: json_view(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [json_view(inner) for inner in value]
    if isinstance(value, (datetime.date, datetime.time, datetime.datetime)):
        return value.isoformat()
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError("a number is not finite")
    return value


def documents(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".toml":
        yield str(path), json_view(tomllib.loads(text))
    elif path.suffix == ".jsonl":
        for number, line in enumerate(text.splitlines(), 1):
            yield f"{path}:{number}", parse_json(line)
    else:
        yield str(path), parse_json(text)


def properties_of(schema):
    if isinstance(schema, dict):
        declared = schema.get("properties", {})
        yield from declared
        for inner in schema.values():
            yield from properties_of(inner)
    elif isinstance(schema, list):
        for inner in schema:
            yield from properties_of(inner)


def keys_of(value):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from keys_of(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from keys_of(inner)


def main(arguments):
    folder, name, *files = arguments
    every_key = "--every-key" in files
    files = [file for file in files if file != "--every-key"]
    if not files:
        raise SystemExit("no file to validate")
    schemas = [json.loads(path.read_text()) for path in pathlib.Path(folder).glob("*.schema.json")]
    store = {schema["$id"]: schema for schema in schemas}
    schema = store[f"urn:lightcal:{name}:1"]
    for one in schemas:
        jsonschema.Draft202012Validator.check_schema(one)
    resolver = jsonschema.RefResolver.from_schema(schema, store=store)
    validator = jsonschema.Draft202012Validator(schema, resolver=resolver)
    failures, used = [], set()
    for file in files:
        try:
            for where, document in documents(pathlib.Path(file)):
                used.update(keys_of(document))
                failures += [f"{where}: {error.json_path}: {error.message}"
                             for error in validator.iter_errors(document)]
        except (ValueError, OSError) as error:
            failures.append(f"{file}: {error}")
    if every_key:
        unused = sorted(set(properties_of(schema)) - used)
        failures += [f"schema {name}: no file uses {key}" for key in unused]
    for failure in failures:
        print(failure)
    print(f"{len(files)} file(s), {len(failures)} failure(s)")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
