#!/usr/bin/env python3
"""Writes interval test vectors as numbers, one a line: convert_itf1788.py [--any-licence] [-o FILE] FOLDER

FOLDER holds the .itl files of the Interval Test Framework for IEEE Std 1788-2015. Taken are the vectors of the forward
operations below, by default only from files under the Apache License 2.0 or the all-permissive licence of the FSF; the
default FILE is tests/data/itf1788.txt. A line is

    OP OPERAND... = RESULT

where an interval is LO,HI or LO,HI,DECORATION (com, dac, def, trv), empty is inf,-inf, and pown has an integer as its
second operand. Numbers are hexadecimal. Of numerals that are no doubles the nearest double is meant.
"""
import argparse, math, pathlib, re, sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
OPS = set("""add sub mul div recip sqr sqrt fma neg pos abs min max floor ceil sign pow pown cbrt hypot
    exp exp2 exp10 expm1 log log2 log10 logp1 sin cos tan cot sec csc asin acos atan acot atan2
    sinh cosh tanh coth sech csch asinh acosh atanh acoth intersection""".split())
PERMISSIVE = ["Licensed under the Apache License, Version 2.0",
              "Copying and distribution of this file, with or without modification"]


def number(text):
    value = float.fromhex(text) if "0x" in text.lower() else float(text)
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    digits, exponent = value.hex().split("p")
    return (digits.rstrip("0").rstrip(".") if "." in digits else digits) + "p" + exponent.lstrip("+")


def operand(token):
    """An interval as text of ours, None for one that has no numbers (not an interval)."""
    if token[0] != "[":
        return str(int(token))
    body, decoration = token[1:].split("]")
    body = {"empty": "infinity,-infinity", "entire": "-infinity,infinity"}.get(body.strip(), body)
    if body.strip() == "nai":
        return None
    ends = [number(end.strip()) for end in body.split(",")]
    return ",".join((ends if len(ends) == 2 else 2 * ends) + ([decoration[1:]] if decoration else []))


def vectors(text):
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)
    for op, rest in re.findall(r"([\w-]+)\s+([^{};=]+=[^{};]+);", text):
        if op not in OPS:
            continue
        sides = [[operand(token) for token in re.findall(r"\[[^\]]*\](?:_\w+)?|[^\s\[\]]+", side)]
                 for side in rest.split("=")]
        if None not in sides[0] + sides[1]:
            yield " ".join([op, *sides[0], "=", *sides[1]])


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "tests" / "data" / "itf1788.txt")
    arguments.add_argument("--any-licence", action="store_true")
    options = arguments.parse_args()
    lines = []
    for path in sorted(options.folder.glob("*.itl")):
        text = path.read_text(encoding="utf-8")
        if options.any_licence or any(licence in text for licence in PERMISSIVE):
            lines += vectors(text)
    if not lines:
        sys.exit(f"{options.folder}: no vectors")
    options.output.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
