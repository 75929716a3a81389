#!/usr/bin/env python3
"""Checks that data flows one way: each folder includes only what the table below lets it include."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

ALL = ["ir", "frontend", "passes", "backends", "runtime", "tools", "tests", "bench"]
MAY_INCLUDE = {  # the longest folder that holds the file decides; its own folder is always allowed
    "ir": [],
    "frontend": ["ir"],
    "passes": ["ir"],
    "backends": ["ir"],
    "backends/*": ["ir", "backends"],  # only backends/kernel.h and its like, not each other
    "runtime/search": ["ir", "passes", "runtime"],
    "runtime": ["ir", "frontend", "passes", "backends", "backends/*"],
    "tools": ["ir", "frontend", "passes", "backends", "backends/*", "runtime"],
    "tests": [*ALL, "backends/*"],
    "bench": [*ALL, "backends/*"],
}
FOREIGN = {  # headers that stay in one place
    "llvm": ["backends/llvm"],
    "llvm-c": ["backends/llvm"],
    "OpenImageIO": ["runtime/image"],
    "CLI": ["tools", "tests/prove", "bench"],
    "nlohmann": ["tools", "tests"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]')


def inside(name, folder):
    """Is `name` in `folder`? "backends" means its files alone, "backends/*" its subfolders."""
    if folder == "backends":
        return name.count("/") == 1 and name.startswith("backends/")
    if folder == "backends/*":
        return name.count("/") > 1 and name.startswith("backends/")
    return name.startswith(folder + "/")


def complaint(name, quote, header):
    """What is wrong with this include in the file `name`, or None."""
    top = header.split("/")[0]
    if top in FOREIGN and not any(inside(name, folder) for folder in FOREIGN[top]):
        return f"<{header}> belongs to {' and '.join(FOREIGN[top])}"
    if quote == "<":
        return f'write "{header}" with quotes: it is ours' if (ROOT / header).is_file() and top in ALL else None
    if top not in ALL or not (ROOT / header).is_file():
        return f'"{header}" is no file, seen from the root of the repository'
    rule = max((folder for folder in MAY_INCLUDE if inside(name, folder)), key=len)
    own = "/".join(name.split("/")[:2]) if rule == "backends/*" else rule
    if not any(inside(header, folder) for folder in [own, *MAY_INCLUDE[rule]]):
        return f"{own} must not include {header}"
    return None


def main():
    faults = []
    for folder in ALL:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in {".h", ".cpp", ".def"}:
                continue
            name = path.relative_to(ROOT).as_posix()
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                if (match := INCLUDE.match(line)) and (fault := complaint(name, *match.groups())):
                    faults.append(f"{name}:{number}: {fault}")
    if faults:
        raise SystemExit("\n".join(faults))


if __name__ == "__main__":
    main()
