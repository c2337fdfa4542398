"""No name with external linkage is defined in two places of the product.

Each layer has an inline namespace, so that a name in two of them is an ambiguity and no undefined
behaviour; but people who read `StripFaces` should not have to find out which.
"""

import collections
import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[1]
FOLDERS = ("core", "codecs", "formats", "converters", "validators", "peers", "cli")

NOT_CODE = re.compile(
    r"//[^\n]*"  # comments
    r"|/\*.*?\*/"
    r'|R"(\w*)\((?:.|\n)*?\)\1"'  # strings
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"  # characters, but not the marks in 1'000
    r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",  # directives
    re.MULTILINE | re.DOTALL)
NAMESPACE = re.compile(r"(?:inline )?namespace ?(?P<path>[\w: ]*)$")
TYPE = re.compile(r"(?:^|\s)(?:struct|class|union|enum(?: class| struct)?)"
                  r"(?: alignas ?\([^)]*\)| \[\[.*?\]\])*"
                  r" (?P<name>[\w:]+(?: ?<.*>)?)(?: final)?(?: : [^(]*| ?:[^:(][^(]*)?$")
FUNCTION = re.compile(r"(?P<name>(?:operator ?(?:\(\)|[^\s\w(]+|\"\" ?_\w+)|[\w:~]+)) ?"
                      r"\((?P<parameters>.*)\)(?: const| noexcept| ->.*| requires.*)*$")


def heads(text):
    """(namespace, what stands before the brace) of each block at namespace scope.

    Inline namespaces do not part names and are left out; what is in an anonymous namespace is not
    ours to name and is skipped.
    """
    text = re.sub(r"= ?\{\}", "= 0", NOT_CODE.sub(" ", text))
    scopes = []  # a namespace's path, or None in any other block
    begin = 0
    for token in re.finditer(r"[{};]", text):
        if token[0] == ";" or token[0] == "}":
            if token[0] == "}":
                scopes.pop()
            begin = token.end()
            continue
        head = re.sub(r"\s+", " ", text[begin:token.start()]).strip()
        begin = token.end()
        if None in scopes:
            scopes.append(None)
        elif match := NAMESPACE.search(head):
            scopes.append(re.sub(r"inline \w+(::)?", "", match["path"]).strip(": ")
                          if not head.startswith("inline") else "")
            if not match["path"].strip():
                scopes[-1] = "(anonymous)"
        else:
            yield "::".join(s for s in scopes if s), head
            scopes.append(None)


def parameter_types(parameters):
    """Without names of parameters and default arguments, as far as they tell overloads apart."""
    depth, types, current = 0, [], ""
    for c in parameters + ",":
        depth += (c in "<([{") - (c in ">)]}")
        if c == "," and depth == 0:
            types.append(current)
            current = ""
        else:
            current += c
    return ",".join(re.sub(r"(?<=[\w>&*]) \w+$|(?<=[&*])\w+$", "", re.sub(r" ?=.*", "", t).strip())
                    for t in types)


def definitions(text):
    """The names that a file defines with external linkage: types, and functions by overload."""
    for namespace, head in heads(text):
        if "(anonymous)" in namespace:
            continue
        head = re.sub(r"^(?:template ?<[^{;]*?> (?=\w))+", "", head)
        if match := TYPE.search(head):
            yield f"{namespace}::{match['name']}"
        elif not re.search(r"(^| )static |^constexpr [^(]*$|^friend |=[^()]*$", head):
            plain = re.sub(r"\) : .*", ")", head)  # a constructor's members
            match = FUNCTION.search(plain)
            if match and "::" not in match["name"]:  # members belong to their class
                yield f"{namespace}::{match['name']}({parameter_types(match['parameters'])})"


def places(files):
    """name -> files that define it."""
    found = collections.defaultdict(list)
    for path, text in files:
        for name in definitions(text):
            found[name].append(path)
    return found


def twice(found):
    return {name: paths for name, paths in found.items() if len(paths) > 1}


def product():
    for folder in FOLDERS:
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path.relative_to(SOURCE).as_posix(), path.read_text()


class Names(unittest.TestCase):
    def test_it_sees_a_type_in_two_layers(self):
        found = twice(places([
            ("a.h", "namespace p::inline a {\n/// {\nstruct Faces {\n  int n() { return '{'; }\n};\n}"),
            ("b.h", "namespace p::inline b {\nclass Faces final : public Base {};\nstruct Other;\n}"),
        ]))
        self.assertEqual(found, {"p::Faces": ["a.h", "b.h"]})

    def test_it_sees_a_function_in_two_layers_but_no_overload(self):
        found = twice(places([
            ("a.cpp", "namespace p::inline a {\nint count(const Mesh& mesh, int n = 3) {}\n}"),
            ("b.cpp", "namespace p::inline b {\nlong count(const Mesh& m, int) {}\n"
                      "int count(const Mesh& mesh) {}\nint Mesh::count(const Mesh& m, int) {}\n}"),
        ]))
        self.assertEqual(found, {"p::count(const Mesh&,int)": ["a.cpp", "b.cpp"]})

    def test_it_leaves_out_what_no_other_file_can_name(self):
        text = "namespace p {\nnamespace {\nstruct Faces {};\nint f() {}\n}\nstatic int g() {}\n}"
        self.assertEqual(list(definitions(text)), [])

    def test_it_parts_what_namespaces_part(self):
        found = twice(places([
            ("a.h", "namespace p::inline a::ply {\nstruct Header {};\n}"),
            ("b.h", "namespace p::inline a::obj {\nstruct Header {};\n}"),
        ]))
        self.assertEqual(found, {})

    def test_nothing_is_defined_twice(self):
        found = places(product())
        for name in ("pstrips::Mesh", "pstrips::Collapse", "pstrips::triangulate(const Mesh&)"):
            self.assertEqual(len(found[name]), 1, name)  # the sources are read at all
        for name, paths in twice(found).items():
            with self.subTest(name=name):
                self.fail(f"is defined in {', '.join(paths)}")


if __name__ == "__main__":
    unittest.main()
