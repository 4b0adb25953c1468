"""Tests that the type stubs declare exactly the members of the module."""
import ast
import inspect
from pathlib import Path

import gsv
from gsv import _native


def declared_in(body):
    """Returns the names that a stub's body declares, each with the names inside it or None."""
    names = {}
    for node in body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = declared_in(node.body)
        elif isinstance(node, ast.FunctionDef):
            names[node.name] = None
        elif isinstance(node, ast.AnnAssign):
            annotation = ast.unparse(node.annotation)
            # `OLD: type[NEW]` declares an old name of the class NEW. The module must have the same
            # members under both names.
            old_name_of = annotation.startswith("type[") and annotation[5:-1].split(".")[-1]
            names[node.target.id] = names[old_name_of] if old_name_of else None
    return {name: within for name, within in names.items() if not name.startswith("_")}


def found_in(holder):
    names = {}
    for name, value in vars(holder).items():
        if not name.startswith("_"):
            names[name] = found_in(value) if inspect.isclass(value) else None
    return names


def test_stub_declares_all_names_of_the_module():
    stub = Path(gsv.__file__).with_name("_native.pyi")
    assert declared_in(ast.parse(stub.read_text()).body) == found_in(_native)


def test_public_functions_have_docstrings():
    for name in gsv.__all__:
        assert inspect.getdoc(getattr(gsv, name)), name
