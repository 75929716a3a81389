#!/usr/bin/env python3
"""The table of ops by target: conformance.py RESULTS.json, what test_backends wrote with --gtest_output=json:RESULTS.json

A number is how many results were compared with the last column of ir/ops.def, bit for bit, in rounding to nearest and
upward. Prints Markdown; fails where a test did.
"""
import json, sys

COMMON = {"name", "value_param", "file", "line", "status", "result", "timestamp", "time", "classname", "failures"}


def main():
    suites = json.load(open(sys.argv[1]))["testsuites"]
    tests = next(suite["testsuite"] for suite in suites if suite["name"] == "Ops/Agreement")
    rows = {test["name"].split("/")[1]: test for test in tests}
    targets = [name for name in next(iter(rows.values())) if name not in COMMON]
    print("| op | " + " | ".join(targets) + " | |\n| --- |" + " ---: |" * len(targets) + " --- |")
    for op, test in rows.items():
        counts = [str(test.get(target, 0)) for target in targets]
        verdict = "FAILS" if "failures" in test else "holds"
        print(f"| {op} | " + " | ".join("-" if count == "0" else count for count in counts) + f" | {verdict} |")
    if any("failures" in test for test in rows.values()):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
