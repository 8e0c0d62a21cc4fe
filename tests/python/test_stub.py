"""The stub of the compiled module: classes, functions, members, arguments and docstrings; and the docstrings of the package."""
import ast
import inspect
import re
import unittest

import tack
from tack import _tack
from tack_test_scenes import source


def named_arguments(doc):
    """The arguments that pybind11 lists in the first line of a docstring."""
    return re.findall(r"(\w+): ", doc.split("\n")[0].replace("::", "."))


def members_of(tree):
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


class Stub(unittest.TestCase):
    def setUp(self):
        tree = ast.parse((source / "python/tack/_tack.pyi").read_text(encoding="utf-8"))
        self.classes = {c.name: c for c in tree.body if isinstance(c, ast.ClassDef)}
        self.functions = members_of(tree)
        self.constants = [node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)]

    def test_the_stub_has_all_names_of_the_compiled_module(self):
        present = {name for name in vars(_tack) if not name.startswith("__")}
        self.assertEqual({*self.classes, *self.functions, *self.constants}, present)

    def test_classes_have_the_members_of_the_stub(self):
        for name in ("Problem", "Object", "Running", "Fit"):
            members = {member: function for member, function in members_of(self.classes[name]).items() if member != "__init__"}
            self.assertEqual(set(members), {member for member in vars(getattr(_tack, name)) if not member.startswith("_")}, name)
            for member, function in members.items():
                doc, known = inspect.getdoc(getattr(getattr(_tack, name), member)) or "", ast.get_docstring(function)
                if known:
                    self.assertTrue(doc.endswith(known), f"{name}.{member}: {doc}")
                arguments = [a.arg for a in function.args.args]
                given = named_arguments(doc)[:len(arguments)]
                if not function.decorator_list and not any(one.startswith("arg") for one in given):
                    self.assertEqual(given, arguments, f"{name}.{member}: {doc}")

    def test_functions_have_the_arguments_of_the_stub(self):
        for name, function in self.functions.items():
            doc, arguments = inspect.getdoc(getattr(_tack, name)), [a.arg for a in function.args.args]
            self.assertEqual(named_arguments(doc)[:len(arguments)], arguments, name)
        self.assertEqual(inspect.getdoc(tack.Problem), ast.get_docstring(self.classes["Problem"]))


class Docstrings(unittest.TestCase):
    """NumPy style: a section of parameters that names those of the signature."""

    def check(self, name, function):
        doc = inspect.getdoc(function)
        self.assertTrue(doc, name)
        self.assertNotRegex(doc, r"(?m)^(Args|Arguments|Returns|Raises):$", name)
        parameters = [one for one in inspect.signature(function).parameters if one not in ("self", "cls")]
        section = re.search(r"(?ms)^Parameters\n-{10}\n(.*?)(?=^\w+\n-+$|\Z)", doc)
        listed = re.findall(r"(?m)^\*{0,2}(\w+) : ", section[1]) if section else []
        self.assertEqual(listed, parameters, name)

    def test_public_functions_and_methods_list_their_parameters(self):
        for name in tack.__all__:
            thing = getattr(tack, name)
            if inspect.isfunction(thing):
                self.check(name, thing)
            elif inspect.isclass(thing):
                self.assertTrue(inspect.getdoc(thing), name)
                for member, function in vars(thing).items():
                    if inspect.isfunction(function) and not member.startswith("_"):
                        self.check(f"{name}.{member}", function)


if __name__ == "__main__":
    unittest.main()
