#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when two classes, structs, unions or enums of one program bear one qualified name: the
linker then takes either one's functions for both.

    check_type_names.py [ROOT]        exit 1 and one line an offence
    check_type_names.py --self-test   plants offences and expects each to be found
"""
import pathlib
import re
import sys
import tempfile

IGNORED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
    r"(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.S | re.M)
NAMESPACE = re.compile(r"(?:inline\s+)?namespace\s*([A-Za-z_][\w:]*)?\s*$")
TEMPLATE_HEAD = re.compile(r"^template\s*<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>\s*(?:requires\b.*?\)\s*)?")
TYPE = re.compile(r"^(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+"
                  r"(?:alignas\s*\([^)]*\)\s*|\[\[[^\]]*\]\]\s*)*"
                  r"([A-Za-z_][\w:]*(?:\s*<[^{}]*>)?)\s*(?:final\s*)?(?::[^:].*)?$", re.S)


def without_text(source):
    """Comments, literals and preprocessor lines as blanks; lines stay where they are."""
    return IGNORED.sub(lambda m: '""' * m.group().startswith(('"', "R")) +
                       "\n" * m.group().count("\n"), source)


def types_of(source):
    """(qualified name, line) of each type defined at namespace scope, but for unnamed namespaces."""
    code = without_text(source)
    scopes, statement, closed = [], "", 0   # `closed`: braces of a body that is passed over
    for at, c in enumerate(code):
        if closed:
            closed += {"{": 1, "}": -1}.get(c, 0)
        elif c == "{":
            words = statement.strip()
            namespace, words = NAMESPACE.match(words), TEMPLATE_HEAD.sub("", words)
            type_name = TYPE.match(words)
            if namespace and namespace.group(1):
                scopes.append(namespace.group(1))
            elif words.startswith("extern"):
                scopes.append("")
            else:
                closed = 1
                if type_name:
                    name = re.sub(r"\s", "", type_name.group(1))
                    yield "::".join([s for s in scopes if s] + [name]), code.count("\n", 0, at) + 1
            statement = ""
        elif c == "}":
            scopes.pop()
            statement = ""
        else:
            statement = "" if c == ";" else statement + c


def offences(root):
    seen = {}
    for house in ("lib", "devices", "app"):
        for path in sorted((root / house).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            for name, line in types_of(path.read_text(encoding="utf-8")):
                seen.setdefault(name, []).append(f"{path.relative_to(root).as_posix()}:{line}")
    return [f"{name}: {' and '.join(places)}" for name, places in seen.items() if len(places) > 1]


ONE = "namespace lightcal {\ntemplate <class T>\nT F() { struct In { int x; }; return {}; }\n%s\n}\n"
PLANTED = [
    ("struct A { int x; };", "struct A { double y; };", 1),
    ("class A final : public B { };", "namespace { struct C {}; }\nenum class A : int { kOne };", 1),
    ("template <class T>\nstruct A { T x; };", "template <class T, class U = B<T>> class A { };", 1),
    ('constexpr const char* k = "{";  // {\nstruct A {};', "struct A {};", 1),
    ("struct A { };", "namespace { struct A { }; }", 0),
    ("struct A { };", "struct A;\nnamespace b { struct A { }; }\nA F(A a) { return a; }", 0),
    ("struct A { struct B {}; };", "struct B { struct A {}; };", 0),
    ("template <>\nstruct A<int> { };", "template <>\nstruct A<double> { };", 0),
]


def self_test():
    for first, second, expected in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (("lib/lightcal/core/a.h", first), ("devices/b.cc", second)):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(ONE % text, encoding="utf-8")
            if len(offences(root)) != expected:
                sys.exit(f"{first!r} and {second!r}: {offences(root)}, not {expected}")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    found = offences(root.resolve())
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
