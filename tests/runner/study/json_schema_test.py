#!/usr/bin/env python3
"""The JSON Schema of study files, judged by a validator that is not ours.

    json_schema_test.py RUNNER SOURCE

It has to accept every study of the repository, and of the malformed ones at least as many have to be refused as it
refuses now: what it says of types, names, ranges, keys and what belongs together. Those left over are of relations
between values, files, units of a wrong dimension and keys that are there twice, of which a schema knows nothing.
"""
import json
import pathlib
import subprocess
import sys

import jsonschema

REFUSED = 258  # of the malformed studies, by today's schema


def malformed(source):
    """The texts of tests/runner/study/bad/studies.txt, which explains how they are written."""
    for line in (source / "tests/runner/study/bad/studies.txt").read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        text = line.split(" |", 2)[2].strip(" ")
        if text.startswith("RAW "):
            text = text[4:]
        elif text.startswith('"'):
            text = '{"study": "bad", ' + text + "}"
        yield text


def refused(validator, text):
    try:
        return not validator.is_valid(json.loads(text))
    except json.JSONDecodeError:
        return True


def main(runner, source):
    answer = subprocess.run([runner, "schema", "study"], check=True, capture_output=True, text=True).stdout
    schema = json.loads(answer)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failures = []
    studies = sorted((source / "studies").glob("*.json"))
    for study in studies:
        for error in validator.iter_errors(json.loads(study.read_text(encoding="utf-8"))):
            failures.append(f"{study.name}: {list(error.absolute_path)}: {error.message[:200]}")
    if len(studies) < 30:
        failures.append(f"only {len(studies)} studies were found below {source}")
    texts = list(malformed(source))
    count = sum(refused(validator, text) for text in texts)
    print(f"{len(studies)} studies accepted, {count} of {len(texts)} malformed ones refused")
    if count < REFUSED:
        failures.append(f"{count} malformed studies are refused, not {REFUSED}")
    misspelt = {"study": "s", "base": {"pile": {"raduis": 0.1}}}
    if validator.is_valid(misspelt):
        failures.append("a misspelt key is accepted")
    radius = schema["definitions"]["scene.pile.radius"]
    if radius.get("default") != 0.125 or "half-width" not in radius.get("description", ""):
        failures.append("pile.radius has no default and meaning to be shown by an editor")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
