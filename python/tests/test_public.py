"""Every public name has a docstring and a full signature; the stub of the compiled module agrees with it."""

import ast
import inspect
import pathlib
import re
import shutil
import subprocess
import unittest

import diurna
from diurna import _core

package = pathlib.Path(diurna.__file__).parent

# Words that words.md keeps out of texts for users.
banned = re.compile(
    r"\b(told|tells|amiss|anew|hardly meant|doubts?|asked for|luminary|felt|its like|stands? for|at best|lest|whence|wherein|thereof)\b", re.I
)


def members(kind):
    """Public functions and properties of a class that the package itself defines, and __init__."""
    for name in dir(kind):
        if name.startswith("_") and name not in ("__init__", "__getitem__", "__len__"):
            continue
        value = inspect.getattr_static(kind, name)
        function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
        if inspect.isfunction(function) and function.__module__.startswith("diurna"):
            yield name, function


def functions():
    """(what, function) of all public functions and methods."""
    for name in diurna.__all__:
        value = getattr(diurna, name)
        if inspect.isclass(value):
            yield from ((f"{name}.{inner}", function) for inner, function in members(value))
        elif callable(value):
            yield name, value


class Public(unittest.TestCase):
    def test_what_is_public_is_listed(self):
        here = {n for n, v in vars(diurna).items() if not n.startswith("_") and not inspect.ismodule(v)}
        self.assertEqual(here, set(diurna.__all__) - {"__version__"})

    def test_dir_shows_public_names_only(self):
        self.assertEqual(dir(diurna), sorted(diurna.__all__))

    def test_docstrings(self):
        names = [(name, getattr(diurna, name)) for name in diurna.__all__ if name != "__version__"]
        self.assertGreater(len(names), 35)
        for name, value in [*names, *functions()]:
            with self.subTest(name):
                own = value.__dict__.get("__doc__") if inspect.isclass(value) else value.__doc__
                generated = own is not None and own.startswith(f"{getattr(value, '__name__', '')}(")
                if name.endswith(".__init__") and generated or name == "Pose.__init__":
                    continue  # of a dataclass: the class's own docstring has the fields
                self.assertTrue(own and len(own.split()) >= 3 and not generated, f"{name} has no docstring: {own!r}")
                self.assertIsNone(banned.search(own), f"{name}: {banned.search(own)}")

    def test_arguments_are_described(self):
        for name, function in functions():
            of_class, _, method = name.rpartition(".")
            docs = (function.__doc__ or "") + (getattr(diurna, of_class).__doc__ if of_class else "")
            if "as of" in docs or name == "Pose.__init__" or method.startswith("__get"):
                continue
            for argument in inspect.signature(function).parameters:
                if argument not in ("self", "which", "name", "time"):
                    with self.subTest(name, argument=argument):
                        self.assertRegex(docs, rf"\b{argument}\b")

    def test_signatures(self):
        for name, function in functions():
            with self.subTest(name):
                signature = inspect.signature(function)
                self.assertIsNot(signature.return_annotation, inspect.Signature.empty, "no type of what it returns")
                for argument in signature.parameters.values():
                    self.assertNotIn(argument.kind, (argument.VAR_POSITIONAL, argument.VAR_KEYWORD), argument)
                    if argument.name != "self":
                        self.assertIsNot(argument.annotation, inspect.Parameter.empty, argument)

    def test_fields_of_tuples_are_described(self):
        for kind in (diurna.Sun, diurna.PathInBand, diurna.Check, diurna.Temperatures, diurna.Mistake, diurna.Pose):
            fields = getattr(kind, "_fields", None) or [f for f in kind.__dataclass_fields__ if not f.startswith("_")]
            for field in fields:
                self.assertIn(f"`{field}`", kind.__doc__)
                self.assertIn(field, kind.__annotations__)

    def test_plain_words_in_the_sources(self):
        for file in sorted(package.glob("*.py")):
            for node in ast.walk(ast.parse(file.read_text())):
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found = banned.search(node.value)
                    self.assertIsNone(found, f"{file.name}:{node.lineno}: {found}")


class Stub(unittest.TestCase):
    """_core.pyi against what pybind11 has made of the module."""

    @classmethod
    def setUpClass(cls):
        cls.tree = ast.parse((package / "_core.pyi").read_text())

    @staticmethod
    def arguments(function):
        return [one.arg for one in function.args.args if one.arg != "self"]

    @staticmethod
    def compiled(function):
        """Names of arguments in the first line of pybind11's docstring."""
        line = function.__doc__.split("\n")[0]
        inside = re.search(r"\((.*)\)(?: ->|$)", line)[1]
        return [n for n in re.findall(r"(?:^|, )(\w+): ", inside) if n != "self"]

    def compare(self, name, node, function):
        with self.subTest(name):
            self.assertEqual(self.arguments(node), self.compiled(function))
            self.assertIsNotNone(node.returns)
            for one in node.args.args:
                self.assertTrue(one.arg == "self" or one.annotation is not None, one.arg)

    def test_functions_and_values(self):
        nodes = {n.name: n for n in self.tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
        values = {n.target.id for n in self.tree.body if isinstance(n, ast.AnnAssign)}
        here = {name for name in dir(_core) if not name.startswith("_")}
        self.assertEqual(set(nodes) | values, here)
        for name, node in nodes.items():
            if isinstance(node, ast.FunctionDef):
                self.compare(name, node, getattr(_core, name))

    def test_classes(self):
        for node in self.tree.body:
            if not isinstance(node, ast.ClassDef):
                continue
            kind = getattr(_core, node.name)
            self.assertTrue(kind.__doc__)
            said = {n.name: n for n in node.body if isinstance(n, ast.FunctionDef)}
            fields = {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
            here = {name for name in vars(kind) if not name.startswith("_")}
            self.assertEqual((set(said) - {"__init__"}) | fields, here)
            for name, inner in said.items():
                if not inner.decorator_list and not isinstance(vars(kind).get(name), property):
                    self.compare(f"{node.name}.{name}", inner, getattr(kind, name))

    def test_the_package_is_typed(self):
        self.assertTrue((package / "py.typed").exists())

    def test_mypy(self):
        mypy = shutil.which("mypy")
        if mypy is None:
            self.skipTest("mypy is not here")
        checked = subprocess.run(
            [mypy, "--strict", "--no-error-summary", "--cache-dir=/dev/null", str(package)], capture_output=True, text=True
        )
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)


if __name__ == "__main__":
    unittest.main()
