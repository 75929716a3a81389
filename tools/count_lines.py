#!/usr/bin/env python3
"""Prints the lines of every file and folder, and fails where a file is over its budget."""

from collections import Counter
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ["cmake", "ir", "frontend", "passes", "backends", "runtime", "tools", "tests", "bench"]
ENDINGS = {".h", ".cpp", ".def", ".py", ".sh", ".cmake", ".js", ".glsl", ".html"}
BUDGETS = [  # the first that matches decides; a `*` matches slashes too
    ("runtime/search/parts/*", 500),
    ("runtime/search/*.cpp", 200),
    ("passes/extend*", 300),
    ("*", 500),
]


def files():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            ours = path.suffix in ENDINGS or name == "tools/dev"
            if ours and path.is_file() and not name.startswith(("tests/golden/", "tests/data/")):
                yield name, len(path.read_text(errors="replace").splitlines())


def main():
    folders, over = Counter(), []
    for name, lines in files():
        budget = next(budget for pattern, budget in BUDGETS if fnmatch(name, pattern))
        if lines > budget:
            over.append(f"{name}: {lines} lines, {lines - budget} over its budget of {budget}")
        folders[name.split("/")[0]] += lines
        print(f"{lines:6} {name}")
    print()
    for folder, lines in folders.items():
        print(f"{lines:6} {folder}/")
    print(f"{folders.total():6} in all")
    if over:
        raise SystemExit("\n".join(["", *over]))


if __name__ == "__main__":
    main()
