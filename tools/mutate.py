#!/usr/bin/env python3
"""Changes one place of the inclusion arithmetic at a time and sees whether a test falls over it: mutate.py --sample 40

Mutants are made in a copy of the tree, build/mutate/tree, in which there are no other tests than those of forms: of
tests/passes and, with --thorough, for what is still alive, those of ops and surfaces in tests/runtime; for the rows of
ir/ops.def that of what ops mean on every backend. Prints a table in
Markdown, row by row. Finished rows lie in build/mutate/done, by the text that was changed, so a run can be stopped and
taken up again. What lives is to be looked at: it changes nothing that is promised, or a test is missing.
"""
import argparse, hashlib, pathlib, random, re, shutil, subprocess, sys, time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutate"
TREE = WORK / "tree"
FOLDERS = ["passes/extend", "passes/polynomial"]
OPS, OPS_TESTS = "ir/ops.def", [("test_backends", ["tests/backends/agreement_test.cpp"])]
TESTS = [  # an executable, and the suites: those of these folders or files
    ("test_passes", ["tests/passes/extend", "tests/passes/polynomial"]),
    ("test_runtime", ["tests/runtime/inclusion_ops_test.cpp", "tests/runtime/inclusion_test.cpp"]),
]
PLAIN = {"add_up": "({0}) + ({1})", "mul_up": "({0}) * ({1})", "div_up": "({0}) / ({1})",
         "fma_up": "imp::fma({0}, {1}, {2})", "sqrt_up": "imp::sqrt({0})",
         "above": "make({0}, {1})", "minus_below": "-make({0}, {1})"}


def code(text):
    """The text with blanks for what is no code: comments, strings, includes, assertions, errors."""
    blank = lambda match: re.sub(r"\S", " ", match.group())
    return re.sub(r'//.*|"(?:[^"\\]|\\.)*"|^\s*#.*|^\s*IMP_ASSERT.*', blank, text, flags=re.M)


def arguments(text, start):
    """(end, [argument…]) of the call whose open bracket is text[start]."""
    depth, pieces, begin = 0, [], start + 1
    for i in range(start, len(text)):
        if text[i] in "([{":
            depth += 1
        elif text[i] in ")]}":
            depth -= 1
        if depth == 0 or (depth == 1 and text[i] == ","):
            pieces.append(text[begin:i].strip())
            begin = i + 1
        if depth == 0:
            return i + 1, pieces
    return len(text), []


def mutants(text):
    """(start, end, replacement, what) of every change to one file."""
    bare, found = code(text), []
    factor = r"[\w.]+(?:\([\w., ]*(?:\([\w., ]*\))?[\w., ]*\))?"

    def words(pattern, replace, what):
        for match in re.finditer(pattern, bare, re.M):
            found.append((match.start(), match.end(), replace(match), what))

    def swap(one, other, what, left=r"\b", right=r"\b"):
        for a, b in ((one, other), (other, one)):
            words(left + re.escape(a) + right, lambda match, b=b: b, what)

    swap(" + ", " - ", "sign", left=r"(?<=[\w)\]])", right="")
    swap(" < ", " <= ", "comparison", left=r"(?<!; [a-z])(?<! <)", right="")  # no ends of loops
    swap(" > ", " >= ", "comparison", left="", right="")
    swap("min", "max", "min, max", right=r"(?=\()")
    swap("nlo", "hi", "end", left=r"(?<=\.)", right=r"\b(?!\.(?:graph|type))")
    swap("true", "false", "flag")
    swap("rules_.add", "rules_.sub", "rule")
    words(r"(?<![\w.!=)])!(?=[\w(])", lambda match: "", "not")
    words(r"(?<=[ (=,{])-(?=[a-zA-Z(])", lambda match: "", "sign")
    words(r"(?<![\w.])\d+\.\d+(?![\w.])|(?<=[*/] )\d+(?![\w.])|(?<=\()\d+(?= [-+*])",
          lambda match: match.group() + " / 2", "constant")
    words(r"(?<![\w.>)\]])" + factor + r" (?:&&|\|\|) (?=[\w!(])", lambda match: "", "term of a condition")
    words(r"(?<=[\w)\]]) (?:&&|\|\|) !?[\w.]+(?:\([\w., ]*\))?(?=[;,)}])", lambda match: "", "term of a condition")
    words(r"(?<=[\w)\]]) [+-] " + factor + r"(?: [*/] " + factor + r")*(?=[;,)}])", lambda match: "", "term of a sum")
    words(r"^ +[\w.\[\]>-]+ (?:[-+|&]?=) [^;\n]*;$", lambda match: "", "assignment")
    words(r"^ +(?:pay|charge|accumulate)\([^;\n]*\);$", lambda match: "", "statement")
    for match in re.finditer(r"\b(?:imp::)?(\w+)\(", bare):
        end, args = arguments(bare, match.end() - 1)
        pieces = [text[match.start():match.end()], end, args]
        name = match.group(1)
        if name in PLAIN and len(args) == PLAIN[name].count("{"):
            found.append((match.start(), end, "(" + PLAIN[name].format(*args) + ")", "rounding"))
        if name in ("sub", "div", "div_up") and len(args) == 2:
            found.append((match.start(), end, f"{pieces[0]}{args[1]}, {args[0]})", "operands"))
        if name == "select" and len(args) == 3 and " " not in args[0].split("(")[0]:
            found.append((match.start(), end, f"{pieces[0]}{args[0]}, {args[2]}, {args[1]})", "branches"))
    return found


def op_mutants(text):
    """Of a row of an op its spelling in LLVM or in GLSL, or its meaning, is that of the next row of this arity and kind."""
    row = re.compile(r'^OP\((\w+), (\d), (\w+), ("\w*"), ("[^"]*"), (.*)\)$', re.M)
    rows = [match for match in row.finditer(text) if match.group(3) != "elementary"]
    found = []
    for match in rows:
        kin = [other for other in rows if other.group(2, 3) == match.group(2, 3)]
        other = kin[(kin.index(match) + 1) % len(kin)]
        for column, what in ((4, "LLVM"), (5, "GLSL"), (6, "meaning")):
            if match.group(column) != other.group(column) and '""' not in (match.group(column), other.group(column)):
                found.append((*match.span(column), other.group(column), what))
    return found


def all_mutants(only):
    ops = (ROOT / OPS).read_text()
    result = [(OPS, *mutant) for mutant in op_mutants(ops)] if re.search(only, OPS) else []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.cpp")):
            name = path.relative_to(ROOT).as_posix()
            if not re.search(only, name):
                continue
            text = path.read_text()
            result += [(name, *mutant) for mutant in sorted(set(mutants(text)))]
    return result


def suites(places):
    """What --gtest_filter takes for all suites in these files."""
    names = set()
    for place in places:
        path = ROOT / place
        for file in [path] if path.is_file() else sorted(path.rglob("*.cpp")):
            names |= set(re.findall(r"^TEST(?:_[PF])?\((\w+)", file.read_text(), re.M))
    return ":".join(f"*{name}.*" for name in sorted(names))


def copy_tree():
    files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout.split("\0")
    wanted = tuple(place for _, places in TESTS + OPS_TESTS for place in places)
    for name in filter(None, files):
        source, target = ROOT / name, TREE / name
        if re.match(r"tests/(?!prove/).*\.cpp$", name) and not name.startswith(wanted):
            continue
        if name in ("passes/CMakeLists.txt", "tests/CMakeLists.txt"):
            continue
        same = target.exists() and target.read_bytes() == source.read_bytes()
        if source.is_file() and not same:
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
    # What is compiled again and again only builds graphs: it need not be fast.
    globs = " ".join(folder.removeprefix("passes/") + "/*.cpp" for folder in FOLDERS)
    rules = {"passes": f"file(GLOB mutated {globs})\n"
                       "set_source_files_properties(${mutated} PROPERTIES COMPILE_OPTIONS -O0)\n",
             "tests": "target_compile_options(test_passes PRIVATE -O0)\n"}
    for folder, more in rules.items():
        text = (ROOT / folder / "CMakeLists.txt").read_text() + more
        file = TREE / folder / "CMakeLists.txt"
        if not file.exists() or file.read_text() != text:
            file.write_text(text)


def run(command, timeout):
    """(exit status, output); 124 where it took too long."""
    try:
        done = subprocess.run(command, cwd=TREE, timeout=timeout, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace")
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return 124, ""


def build(target, jobs):
    return run(["cmake", "--build", "build/release", "-j", str(jobs), "--target", target], 3600)


def verdict(options, tests):
    """"killed by …", "alive" or "does not compile", of the tree as it stands."""
    for executable, places in tests:
        if build(executable, options.jobs)[0] != 0:
            return "does not compile"
        status, output = run([f"build/release/{executable}", "--gtest_fail_fast", "--gtest_brief=1",
                              f"--gtest_filter={suites(places)}"], options.timeout)
        failed = re.search(r"\[  FAILED  \] (?:\w+/)?(\w+\.\w+)", output)
        if status != 0:
            return "killed by " + (failed.group(1) if failed else "time" if status == 124 else "a crash")
    return "alive"


def tests_of(name, options):
    return OPS_TESTS if name == OPS else TESTS if options.thorough else TESTS[:1]


def shown(text):
    return "`" + re.sub(r"\s+", " ", text.strip() or " ").replace("|", "\\|") + "`"


def row(mutant, options):
    name, start, end, replacement, what = mutant
    text = (ROOT / name).read_text()
    changed = text[:start] + replacement + text[end:]
    key = WORK / "done" / hashlib.sha256((name + "\0" + changed).encode()).hexdigest()[:24]
    if key.exists():
        return key.read_text()
    (TREE / name).write_text(changed)
    began = time.monotonic()
    try:
        found = verdict(options, tests_of(name, options))
    finally:
        (TREE / name).write_text(text)
    line = text.count("\n", 0, start) + 1
    was, now = (shown(whole.splitlines()[line - 1]) for whole in (text, changed))
    result = f"| {name}:{line} | {what} | {was} | {now} | {found} |"
    key.parent.mkdir(parents=True, exist_ok=True)
    key.with_suffix(".new").write_text(result)
    key.with_suffix(".new").rename(key)
    print(f"{time.monotonic() - began:.0f} s", file=sys.stderr)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sample", type=int, default=0, help="so many mutants, at random (all)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="of files whose names match this")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=int, default=900, help="seconds for the tests of a mutant")
    parser.add_argument("--thorough", action="store_true", help="the tests of tests/runtime too")
    parser.add_argument("--list", action="store_true", help="print the mutants, and try none")
    options = parser.parse_args()

    chosen = all_mutants(options.only)
    count = len(chosen)
    if options.sample:
        chosen = random.Random(options.seed).sample(chosen, min(options.sample, count))
    if options.list:
        for name, start, end, replacement, what in chosen:
            text = (ROOT / name).read_text()
            print(f"{name}:{text.count(chr(10), 0, start) + 1}: {what}: {shown(text[start:end])} -> {shown(replacement)}")
        print(f"{count} mutants", file=sys.stderr)
        return

    copy_tree()
    run(["cmake", "--preset", "release", "-DIMP_LLVM_SHARED=ON"], 600)
    for tests in {tests_of(name, options)[0][0]: tests_of(name, options) for name, *_ in chosen}.values():
        if verdict(options, tests) != "alive":
            raise SystemExit("the tests do not pass as things are")
    print("| place | what | before | after | |\n| --- | --- | --- | --- | --- |")
    counts = {"killed": 0, "alive": 0, "does not compile": 0}
    for mutant in chosen:
        text = row(mutant, options)
        print(text, flush=True)
        last = text.rsplit("|", 2)[1].strip()
        counts[next(word for word in counts if last.startswith(word))] += 1
    print(f"\n{len(chosen)} of {count} mutants: " + ", ".join(f"{n} {word}" for word, n in counts.items()))


if __name__ == "__main__":
    main()
