"""Reads formulas of reactions, and computes them for arrays of numpy. The filters have a parser of VTK."""

import ast
import re

import numpy

from ._inputs import Error

_OPERATORS = {
    ast.Add: numpy.add, ast.Sub: numpy.subtract, ast.Mult: numpy.multiply, ast.Div: numpy.divide,
    ast.Pow: numpy.power, ast.UAdd: numpy.positive, ast.USub: numpy.negative, ast.Not: numpy.logical_not,
    ast.And: numpy.logical_and, ast.Or: numpy.logical_or, ast.Eq: numpy.equal, ast.NotEq: numpy.not_equal,
    ast.Lt: numpy.less, ast.LtE: numpy.less_equal, ast.Gt: numpy.greater, ast.GtE: numpy.greater_equal}

# Functions by their names, with the least and the largest number of their arguments.
_FUNCTIONS = {
    "if_": (numpy.where, 3, 3), "min": (numpy.minimum, 2, 9), "max": (numpy.maximum, 2, 9),
    "ln": (numpy.log, 1, 1), **{name: (getattr(numpy, name), 1, 1) for name in (
        "abs", "ceil", "cos", "cosh", "exp", "floor", "log", "log10", "sign", "sin", "sinh", "sqrt", "tan",
        "tanh")}}


class _Unreadable(Exception):
    pass


def _call(node, variables):
    name = node.func.id if isinstance(node.func, ast.Name) else ""
    if name not in _FUNCTIONS or node.keywords:
        raise _Unreadable(f"Undefined symbol: '{name}'")
    function, least, most = _FUNCTIONS[name]
    arguments = [_value(argument, variables) for argument in node.args]
    if not least <= len(arguments) <= most:
        raise _Unreadable(f"wrong number of arguments of {name.rstrip('_')}")
    if most == 9:
        result = arguments[0]
        for argument in arguments[1:]:
            result = function(result, argument)
        return result
    return function(*arguments)


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
    parts = {ast.UnaryOp: lambda: (node.op, node.operand), ast.BinOp: lambda: (node.op, node.left, node.right),
             ast.BoolOp: lambda: (node.op, *node.values),
             ast.Compare: lambda: (node.ops[0], node.left, *node.comparators)}.get(type(node), tuple)()
    if len(parts) not in (2, 3) or type(parts[0]) not in _OPERATORS:
        raise _Unreadable("it has a part that is no operator, function or number")
    result = _OPERATORS[type(parts[0])](*(_value(part, variables) for part in parts[1:]))
    return result.astype(float) if result.dtype == bool else result


def _read(name, formula, variables):
    """Returns the parsed formula. Raises Error if it cannot be read."""
    try:
        text = re.sub(r"\bif\s*\(", "if_(", formula).replace("**", "* *").replace("^", "**")
        parsed = ast.parse(text.strip(), mode="eval").body
        _value(parsed, {variable: numpy.full(1, 0.5) for variable in variables})
    except (SyntaxError, ValueError, _Unreadable) as error:
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
