#!/usr/bin/env python3
"""Writes the exact answers that tests compare with: make_test_data.py SURFACES_DIR

SURFACES_DIR holds catalogue.json, values.json and rays.json. The result is tests/data/surfaces.txt, one record a line,
words separated by spaces; blank lines and lines that begin with # are comments. Every line belongs to the last
`surface` above it, and `root`, `near` and `ideal` to the last `ray`.

    surface ID KIND                                   KIND: algebraic, transcendental, dynamic
    | TEXT                                            a line of its .imp source
    box    XLO YLO ZLO XHI YHI ZHI                    the domain, or
    sphere XLO YLO ZLO XHI YHI ZHI                    the box around the sphere that is the domain
    value  X Y Z W  F FX FY FZ FXX FXY FXZ FYY FYZ FZZ
    ray    OX OY OZ DX DY DZ T0 T1 W FLAGS            FLAGS: -, or zero (f is 0 all along), unresolved, zero,unresolved
    root   T M                                        a root in [T0, T1] of multiplicity M, in order of T
    near   T GAP                                      an almost-root or a close pair: GAP is its half width in t
    ideal  T M                                        a root of the ray that was meant, before its numbers were rounded

X Y Z, O, D, T0, T1 and W are exact doubles; W is the time, - where there is none. All other numbers are the doubles
nearest to answers computed with 25 digits or more; - where a derivative does not exist or the number is beyond them.
"""
import json, math, pathlib, sys

OUT = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data" / "surfaces.txt"


def source(e):
    point = lambda v: "(" + ", ".join(map(str, v)) + ")"
    lines = [f"{p['name']} = {p['default']}" for p in e["parameters"]]
    if e["time"]:
        lines.append(f"time {e['time']['name']} = {e['time']['default']}")
    lines += [f"{d['name']} = {d['expr']}" for d in e["definitions"]]
    lines.append(f"surface {e['id']}: {e['formula']} = 0")
    d = e["domain"]
    lines.append(f"domain box({point(d['min'])}, {point(d['max'])})" if d["type"] == "box"
                 else f"domain sphere(center: {point(d['center'])}, radius: {d['radius']})")
    return lines


def number(v):
    """The shortest text of the nearest double."""
    if v is None or not math.isfinite(float(v)):
        return "-"
    return repr(float(v)).removesuffix(".0")


def record(word, numbers, *rest):
    return " ".join([word, *map(number, numbers), *map(str, rest)])


def domain(d):
    if d["type"] == "box":
        return record("box", d["min"] + d["max"])
    c, r = d["center"], d["radius"]
    return record("sphere", [v - r for v in c] + [v + r for v in c])


def value(v):
    return record("value", v["p"] + [v.get("w"), v["f"]] + (v["g"] or [None] * 3) + (v["h"] or [None] * 6))


def ray(r):
    flags = ",".join(flag for flag, key in (("zero", "zero_on_ray"), ("unresolved", "unresolved")) if r.get(key))
    yield record("ray", r["o"] + r["d"] + [r["t0"], r["t1"], r.get("w")], flags or "-")
    for q in r["roots"]:
        yield record("root", [q["t"]], q["m"])
    for n in r.get("near") or []:
        if n["gap"] is not None:
            yield record("near", [n["t"], n["gap"]])
    for q in (r.get("ideal") or {}).get("roots") or []:
        yield record("ideal", [q["t"]], q["m"])


def surface(e, values, rays):
    yield from ["", f"surface {e['id']} {e['kind']}", *("| " + line for line in source(e)), domain(e["domain"])]
    for v in values:
        if not any(isinstance(c, str) for c in v["p"]):        # a point given in decimals is no double
            yield value(v)
    for r in rays:
        yield from ray(r)


if len(sys.argv) != 2:
    sys.exit(__doc__)
load = lambda name: json.loads(pathlib.Path(sys.argv[1], name).read_text())["surfaces"]
catalogue, values, rays = load("catalogue.json"), load("values.json"), load("rays.json")
lines = ["# Written by tools/make_test_data.py, which describes the format."]
for e in catalogue:
    if e["kind"] != "csg":
        lines += surface(e, values.get(e["id"], []), rays.get(e["id"], []))
OUT.parent.mkdir(parents=True, exist_ok=True)
OUT.write_text("\n".join(lines) + "\n")
