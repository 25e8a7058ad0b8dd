"""Declared parameters as fields of a Processing dialog, and their values back."""

from __future__ import annotations

import re
from typing import Any

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterNumber,
    QgsProcessingParameterString,
)

from ...algorithms.core.errors import BareEarthError
from ...algorithms.core.parameters import Declaration, ParameterSet
from .. import compat
from ..i18n import tr
from .choices import ChoiceParameter, value_of, values_of, with_labels

_SYMBOLS = {"deg": "°"}
_LISTS = ("numbers", "integers")
_FEWEST_DECIMALS = 3
# A longer list of choices would hide the rest of the help: there the names have to do.
_MOST_EXPLAINED = 12


def field_of(declaration: Declaration, is_shown: bool = True) -> QgsProcessingParameterDefinition:
    """Return the Processing parameter for a declared one.

    Parameters
    ----------
    declaration : Declaration
        What is said of the parameter.
    is_shown : bool
        Whether the dialog shows it at once; never if it is advanced.

    Returns
    -------
    QgsProcessingParameterDefinition
        With label, unit, limits, default and help.
    """
    name, label = declaration.name.upper(), title_of(declaration)
    default, optional = declaration.default, declaration.optional
    if declaration.kind == "choices":
        field = ChoiceParameter(
            name, label, list(declaration.choices), True, list(default), optional, True
        )
        field = with_labels(field, list(map(tr, declaration.choices.values())))
    elif declaration.kind == "boolean":
        # The designer asks for all that is not optional, in models of before it was there as well.
        field = QgsProcessingParameterBoolean(name, label, default, True)
    elif declaration.kind == "choice":
        # The values themselves, not their places in the list: they stay true in saved models.
        # As for booleans: what is advanced may be newer than a stored model.
        optional = optional or declaration.advanced
        field = ChoiceParameter(
            name, label, list(declaration.choices), False, default, optional, True
        )
        field = with_labels(field, list(map(tr, declaration.choices.values())))
    elif declaration.kind in _LISTS:
        default = None if default is None else ", ".join(f"{each:g}" for each in default)
        field = QgsProcessingParameterString(name, label, default, False, optional)
    else:
        field = _number_field(declaration, name, label)
    field.setHelp(help_of(declaration))
    if declaration.advanced or not is_shown:
        field.setFlags(field.flags() | compat.ADVANCED)
    return field


def _number_field(declaration: Declaration, name: str, label: str) -> QgsProcessingParameterNumber:
    kind = compat.INTEGER if declaration.kind == "integer" else compat.NUMBER
    field = QgsProcessingParameterNumber(
        name, label, kind, declaration.default, declaration.optional
    )
    if declaration.minimum is not None:
        field.setMinimum(declaration.minimum)
    if declaration.maximum is not None:
        field.setMaximum(declaration.maximum)
    if declaration.kind == "number":
        # The usual six decimals are noise in a dialog of metres and degrees.
        shown = (declaration.minimum, declaration.default)
        decimals = max(_FEWEST_DECIMALS, *(_decimals(each) for each in shown if each is not None))
        field.setMetadata({"widget_wrapper": {"decimals": decimals}})
    return field


def _decimals(value: float) -> int:
    return len(f"{value:f}".rstrip("0").partition(".")[2])


def title_of(declaration: Declaration) -> str:
    """Return the label with the unit, in the user's language."""
    unit = _SYMBOLS.get(declaration.unit) or tr(declaration.unit)
    label = tr(declaration.label)
    return f"{label} [{unit}]" if unit else label


def help_of(declaration: Declaration) -> str:
    """Return the help, with what each choice is called in scripts, in the user's language."""
    text = tr(declaration.help)
    if not declaration.choices:
        return text
    choices = ((value, tr(label)) for value, label in declaration.choices.items())
    is_long = len(declaration.choices) > _MOST_EXPLAINED
    names = (
        value if is_long or value == label.lower().replace(" ", "-") else f"{value}: {label}"
        for value, label in choices
    )
    return f"{text} {tr('In scripts')}: {'; '.join(names)}."


def parameters_of(
    algorithm: QgsProcessingAlgorithm,
    declared: type[ParameterSet],
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> ParameterSet:
    """Return the declared parameters with the values that the user gave.

    Raises
    ------
    BareEarthError
        If a value is not allowed; the text says which and why.
    """
    return declared(
        **{
            each.name: _value(algorithm, each, parameters, context)
            for each in declared.declarations()
        }
    )


def _value(
    algorithm: QgsProcessingAlgorithm,
    declaration: Declaration,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> Any:
    name = declaration.name.upper()
    given = parameters.get(name)
    if declaration.kind == "boolean":
        return algorithm.parameterAsBool(parameters, name, context)
    if name in parameters and (compat.is_null(given) or given == ""):
        # Emptied on purpose; parameterAs... would return the default instead.
        return declaration.default if declaration.kind == "choice" else None
    if declaration.kind == "choice":
        if isinstance(given, (str, int)):
            return value_of(given, list(declaration.choices))
        return algorithm.parameterAsEnumString(parameters, name, context) or None
    if declaration.kind == "choices":
        if isinstance(given, (str, list, tuple)):
            return values_of(given, list(declaration.choices))
        return algorithm.parameterAsEnumStrings(parameters, name, context)
    if declaration.kind in _LISTS:
        if isinstance(given, (list, tuple)):
            return given
        text = algorithm.parameterAsString(parameters, name, context)
        return re.split(r"[\s,;]+", text.strip()) if text.strip() else None
    if name not in parameters:
        return declaration.default
    if isinstance(given, str) and not _is_number(given):
        # parameterAsDouble would return the default without a word.
        raise BareEarthError(
            tr("{label} must be a number, not {value}.").format(
                label=tr(declaration.label), value=repr(given)
            )
        )
    # As a number with decimals in either case: 2.5 is not to become 2 where a whole one is asked.
    return algorithm.parameterAsDouble(parameters, name, context)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
