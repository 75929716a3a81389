#!/usr/bin/env python3
"""Compares the hand-written examples with a catalogue of surfaces: check_examples.py CATALOGUE.json

For every entry of the catalogue but the CSG ones, examples/surfaces/<id>.imp must have the same domain and time and, at
random points and times of them, the same value: both are translated to Python and evaluated in double. It knows the
part of the language that the examples use, and trusts that they are well formed. Prints a line for each that disagrees.
"""
import json, math, pathlib, random, re, sys

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent / "examples" / "surfaces"


def chebyshev(n, x):
    before, last = 1, x
    for _ in range(n - 1):
        before, last = last, 2 * x * last - before
    return last if n else 1


BUILT_IN = {name: getattr(math, name) for name in ("pi", "sin", "cos", "acos", "cosh", "acosh", "exp", "sqrt")} | {
            "abs": abs, "min": min, "max": max,
            "cbrt": lambda v: math.copysign(abs(v) ** (1 / 3), v), "T": chebyshev,
            "sum_": lambda lo, hi, term: sum(map(term, range(lo, hi + 1))),
            "product_": lambda lo, hi, factor: math.prod(map(factor, range(lo, hi + 1)))}


def python(expression):
    """sum(i, 1, n, e) becomes sum_(1, n, lambda i: e); its bounds hold no comma. Bars do not nest."""
    ranged = re.sub(r"\b(sum|product)\((\w+),([^,]*),([^,]*),", r"\1_(\3,\4, lambda \2:", expression)
    barred = re.sub(r"\|([^|]*)\|", r"abs(\1)", ranged)
    return "(" + barred.replace("^", "**").strip() + ")"


def statements(text):
    """Joins continuation lines (indented) and drops comments."""
    found = []
    for line in (line.split("#")[0].rstrip() for line in text.splitlines()):
        if line and line[0].isspace():
            found[-1] += " " + line.strip()
        elif line:
            found.append(line)
    return found


def read(text):
    """(definitions, f, domain, time) of an .imp source: definitions are Python statements, time (name, lo, hi, now)."""
    definitions, f, domain, time = [], None, None, None
    for s in statements(text):
        word = s.split()[0]
        if word == "surface":
            left, _, right = s.split(":", 1)[1].partition("=")
            f = python(left) + " - " + python(right or "0")
        elif word == "domain":
            domain = eval(re.sub(r"(center|radius):", r"\1=", s.removeprefix("domain")).strip(),
                         {"box": lambda lo, hi: (lo, hi), "sphere": lambda radius, center=(0, 0, 0): (center, radius)})
        elif word == "time":
            name, now, lo, hi = re.fullmatch(r"time (\w+) = (.*) in \[(.*),(.*)\]", s).groups()
            time = name, *(eval(python(end), dict(BUILT_IN)) for end in (lo, hi, now))
        elif word not in ("camera", "light"):
            head, body = re.sub(r"^param ", "", re.sub(r" in \[.*", "", s)).split("=", 1)
            name, _, arguments = head.strip().partition("(")
            definitions.append(f"{name} = " + (f"lambda {arguments[:-1]}: " if arguments else "") + python(body))
    return definitions, f, domain, time


def value(surface, point, moment):
    definitions, f, _, time = surface
    names = BUILT_IN | dict(zip("xyz", point)) | ({time[0]: moment} if time else {})
    for d in definitions:
        exec(d, names)
    return eval(f, names)


def to_imp(entry):
    lines = [f"{p['name']} = {p['default']}" for p in entry["parameters"]]
    if t := entry["time"]:
        lines.append(f"time {t['name']} = {t['default']} in [{t['range'][0]}, {t['range'][1]}]")
    lines += [f"{d['name']} = {d['expr']}" for d in entry["definitions"]]
    lines.append(f"surface {entry['id']}: {entry['formula']}")
    d = entry["domain"]
    lines.append(f"domain box({tuple(d['min'])}, {tuple(d['max'])})" if d["type"] == "box"
                 else f"domain sphere(center: {tuple(d['center'])}, radius: {d['radius']})")
    return "\n".join(lines)


def points(domain, count=50):
    lo, hi = domain
    if not isinstance(hi, tuple):
        lo, hi = [c - domain[1] for c in lo], [c + domain[1] for c in lo]
    return [[random.uniform(a, b) for a, b in zip(lo, hi)] for _ in range(count)]


def disagreement(entry):
    path = EXAMPLES / f"{entry['id']}.imp"
    if not path.exists():
        return "no such file"
    example, expected = read(path.read_text()), read(to_imp(entry))
    if example[2] != expected[2]:
        return f"domain is {example[2]}, not {expected[2]}"
    if example[3] != expected[3]:
        return f"time is {example[3]}, not {expected[3]}"
    for p in points(expected[2]):
        moment = random.uniform(*expected[3][1:3]) if expected[3] else None
        a, b = value(example, p, moment), value(expected, p, moment)
        if not abs(a - b) <= 1e-9 * (1 + abs(b)):
            return f"f at {p} is {a}, not {b}"
    return None


if len(sys.argv) != 2:
    sys.exit(__doc__)
random.seed(1)
entries = [e for e in json.loads(pathlib.Path(sys.argv[1]).read_text())["surfaces"] if e["kind"] != "csg"]
wrong = [(e["id"], why) for e in entries if (why := disagreement(e))]
for name, why in wrong:
    print(f"{name}: {why}")
print(f"{len(entries)} surfaces, {len(wrong)} disagree")
sys.exit(bool(wrong))
