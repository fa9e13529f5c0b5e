"""Reads formulas of reactions, and computes them for arrays of numpy. The filters have a parser of VTK."""

import ast
import functools
import re

import numpy

from ._inputs import Error

_OPERATORS = {
    ast.Add: numpy.add, ast.Sub: numpy.subtract, ast.Mult: numpy.multiply, ast.Div: numpy.divide,
    ast.Pow: numpy.power, ast.UAdd: numpy.positive, ast.USub: numpy.negative, ast.And: numpy.logical_and,
    ast.Or: numpy.logical_or, ast.Eq: numpy.equal, ast.NotEq: numpy.not_equal, ast.Lt: numpy.less,
    ast.LtE: numpy.less_equal, ast.Gt: numpy.greater, ast.GtE: numpy.greater_equal}

# Functions by the number of their arguments. Those of "many" take two or more.
_FUNCTIONS = {
    1: {"ln": numpy.log, "asin": numpy.arcsin, "acos": numpy.arccos, "atan": numpy.arctan,
        **{name: getattr(numpy, name) for name in (
            "abs", "ceil", "cos", "cosh", "exp", "floor", "log", "log10", "sign", "sin", "sinh", "sqrt",
            "tan", "tanh")}},
    2: {"pow": numpy.power},
    3: {"if_": numpy.where},
    "many": {"min": numpy.minimum, "max": numpy.maximum}}


class _Unreadable(Exception):
    pass


def _call(node, variables):
    name = getattr(node.func, "id", "")
    arguments = [_value(argument, variables) for argument in node.args]
    if name in _FUNCTIONS["many"] and len(arguments) > 1:
        return functools.reduce(_FUNCTIONS["many"][name], arguments)
    if name in _FUNCTIONS.get(len(arguments), ()) and not node.keywords:
        return _FUNCTIONS[len(arguments)][name](*arguments)
    if any(name in functions for functions in _FUNCTIONS.values()):
        raise _Unreadable(f"{name.rstrip('_')} has too few or too many arguments")
    raise _Unreadable(f"Undefined symbol: '{name}'" if name not in variables
                      else f"'*' is missing behind '{name}'")


def _value(node, variables):
    """Returns the value of a part of a formula. variables: arrays by name."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return float(node.value)
    if isinstance(node, ast.Name):
        if node.id not in variables:
            raise _Unreadable(f"Undefined symbol: '{node.id}'")
        return variables[node.id]
    if isinstance(node, ast.Call):
        return _call(node, variables)
    if isinstance(node, ast.UnaryOp):
        operator, parts = node.op, [node.operand]
    elif isinstance(node, ast.BinOp):
        operator, parts = node.op, [node.left, node.right]
    elif isinstance(node, ast.BoolOp):
        operator, parts = node.op, node.values
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        operator, parts = node.ops[0], [node.left, node.comparators[0]]
    else:
        operator, parts = None, []
    if type(operator) not in _OPERATORS:
        raise _Unreadable("Syntax error")
    values = [_value(part, variables) for part in parts]
    function = _OPERATORS[type(operator)]
    result = function(*values) if len(values) == 1 else functools.reduce(function, values)
    return result.astype(float) if result.dtype == bool else result


def _read(name, formula, variables):
    """Returns the parsed formula. Raises Error if it cannot be read."""
    if not isinstance(formula, str):
        raise Error(f"{name} is {formula!r}. It must be a text.")
    if not formula.strip():
        raise Error(f"The Model Custom needs a formula for {name}.")
    text = re.sub(r"\bif\s*\(", "if_(", formula).replace("**", "* *").replace("^", "**")
    try:
        parsed = ast.parse(" ".join(text.split()), mode="eval").body
        with numpy.errstate(all="ignore"):
            _value(parsed, {variable: numpy.full(1, 0.5) for variable in variables})
    except (SyntaxError, ValueError, OverflowError, RecursionError, MemoryError, _Unreadable) as error:
        cause = str(error) if isinstance(error, _Unreadable) else "Syntax error"
        example = "u*(1-u)" if len(variables) == 1 else "0.1 - u + u^2*v"
        raise Error(f"{name} '{formula}' cannot be read: {cause}. It is a formula of "
                    f"{' and '.join(variables)}, such as {example}.") from None
    return parsed


def rates(formulas):
    """Returns a function of an array (N, K) of K species that returns their rates (N, K)."""
    variables = ("u", "v")[:len(formulas)]
    parsed = [_read(f"Reaction {variable.upper()}", formula, variables)
              for variable, formula in zip(variables, formulas)]

    def compute(values):
        columns = dict(zip(variables, values.T))
        with numpy.errstate(all="ignore"):
            return numpy.column_stack([numpy.broadcast_to(_value(node, columns), len(values))
                                       for node in parsed])

    return compute
