"""The stub of the compiled module: classes, members, arguments and docstrings."""
import ast
import inspect
import re
import unittest

import tack
from tack_test_scenes import source


class Stub(unittest.TestCase):
    def test_the_stub_describes_the_compiled_module(self):
        tree = ast.parse((source / "python/tack/_tack.pyi").read_text(encoding="utf-8"))
        stub = {c.name: c for c in tree.body if isinstance(c, ast.ClassDef)}
        self.assertEqual(set(stub), {"InputError", "SimulationError", "Problem"})
        self.assertEqual(inspect.getdoc(tack.Problem), ast.get_docstring(stub["Problem"]))
        members = {f.name: f for f in stub["Problem"].body if isinstance(f, ast.FunctionDef)}
        self.assertEqual(set(members), {name for name in vars(tack.Problem) if not name.startswith("_")})
        for name, function in members.items():
            doc = inspect.getdoc(getattr(tack.Problem, name))
            self.assertTrue(doc.endswith(ast.get_docstring(function)), f"{name}: {doc}")
            if not function.decorator_list:  # no property
                arguments = [a.arg for a in function.args.args]
                self.assertEqual(re.findall(r"(\w+): ", doc.split("\n")[0].replace("::", "."))[:len(arguments)], arguments, doc)


if __name__ == "__main__":
    unittest.main()
