"""Makes fields of a Processing dialog from declared parameters, and reads their values."""

from __future__ import annotations

import re

from qgis.core import (
    QgsProcessingParameterBoolean,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterNumber,
    QgsProcessingParameterString,
)

from ...algorithms.core.parameters import Declaration, ParameterSet
from .. import compat
from ..i18n import mark, tr
from .choices import OFF, ON, ChoiceParameter, value_of, values_of, with_labels
from .feedback import Refusal
from .request import Request

# As a name, so that the widget is imported only in dialogs, not in qgis_process.
_CHECK_WIDGET = f"{__package__}.widgets.CheckWidget"
_SYMBOLS = {"deg": "°", "m2": "m²"}
_LISTS = ("numbers", "integers")
_FEWEST_DECIMALS = 3
# Most choices that the help explains; it only names those of longer lists.
_MOST_EXPLAINED = 12


def field_of(
    declaration: Declaration, is_shown: bool, no_choice: str = ""
) -> QgsProcessingParameterDefinition:
    """Return the field of a declared parameter, shown or advanced, with label, unit, limits,
    default and help; `no_choice` is the label of no value, if it is empty at first.
    """
    name, label = declaration.name.upper(), title_of(declaration)
    default, optional = declaration.default, declaration.optional
    choices = declaration.choices or ({OFF: "No", ON: "Yes"} if no_choice else {})
    if choices:
        # Stored as values, not as positions in the list, so that saved models stay valid.
        is_list = declaration.kind == "choices"
        default = None if no_choice else list(default) if is_list else default
        # Advanced ones are optional as booleans are, since they can be newer than a saved model.
        optional = optional or bool(no_choice) or (declaration.advanced and not is_list)
        field = ChoiceParameter(name, label, list(choices), is_list, default, optional, True)
        field = with_labels(field, list(map(tr, choices.values())), no_choice and tr(no_choice))
    elif declaration.kind == "boolean":
        # Optional: QGIS 3.22 refuses old models without this parameter otherwise.
        field = QgsProcessingParameterBoolean(name, label, default, True)
        field.setMetadata({"widget_wrapper": {"class": _CHECK_WIDGET}})
    elif declaration.kind in _LISTS:
        default = None if default is None else ", ".join(f"{number:g}" for number in default)
        field = QgsProcessingParameterString(name, label, default, False, optional)
    else:
        field = _number_field(declaration, name, label)
    field.setHelp(help_of(declaration))
    if not is_shown:
        field.setFlags(field.flags() | compat.ADVANCED)
    return field


def _number_field(declaration: Declaration, name: str, label: str) -> QgsProcessingParameterNumber:
    kind = compat.INTEGER if declaration.kind == "integer" else compat.NUMBER
    # Advanced ones can be newer than a saved model, as choices.
    optional = declaration.optional or declaration.advanced
    field = QgsProcessingParameterNumber(name, label, kind, declaration.default, optional)
    if declaration.minimum is not None:
        field.setMinimum(declaration.minimum)
    if declaration.maximum is not None:
        field.setMaximum(declaration.maximum)
    if declaration.kind == "number":
        # The usual six decimals are too many for metres and degrees.
        shown = (one for one in (declaration.minimum, declaration.default) if one is not None)
        decimals = (len(f"{one:f}".rstrip("0").partition(".")[2]) for one in shown)
        metadata = {"decimals": max(_FEWEST_DECIMALS, *decimals)}
        field.setMetadata({"widget_wrapper": metadata})
    return field


def title_of(declaration: Declaration) -> str:
    """Return the label with the unit, in the user's language."""
    unit = _SYMBOLS.get(declaration.unit) or tr(declaration.unit)
    label = tr(declaration.label)
    return f"{label} [{unit}]" if unit else label


def help_of(declaration: Declaration) -> str:
    """Return the help, with the names of choices in scripts."""
    if not declaration.choices:
        return declaration.help
    choices = ((value, tr(label)) for value, label in declaration.choices.items())
    is_long = len(declaration.choices) > _MOST_EXPLAINED
    names = (
        value if is_long or value == label.lower().replace(" ", "-") else f"{value}: {label}"
        for value, label in choices
    )
    return f"{declaration.help} In scripts: {'; '.join(names)}."


def parameters_of(request: Request, declared: type[ParameterSet]) -> ParameterSet:
    """Return the declared parameters with the values of the user, if these are allowed."""
    return declared(**{one.name: _value(request, one) for one in declared.declarations()})


def _value(request: Request, declaration: Declaration) -> object:
    name = declaration.name.upper()
    given = request.parameters.get(name)
    if declaration.kind == "boolean":
        if not isinstance(request.algorithm.parameterDefinition(name), ChoiceParameter):
            return request.read("Bool", name)
        given = value_of("" if compat.is_empty(given) else given, [OFF, ON])
        return given in (ON, True) if given != "" else declaration.default
    if name in request.parameters and (compat.is_null(given) or given == ""):
        # The user emptied the field; parameterAs... would return the default. None is refused later
        # where a value is needed, except in fields that can be newer than a saved model.
        has_default = declaration.kind == "choice" or declaration.advanced
        return declaration.default if has_default and not declaration.optional else None
    if declaration.kind == "choice":
        if isinstance(given, (str, int)):
            return value_of(given, list(declaration.choices))
        chosen = request.read("EnumString", name)
        return chosen or (None if declaration.optional else declaration.default)
    if declaration.kind == "choices":
        if isinstance(given, (str, list, tuple)):
            return values_of(given, list(declaration.choices))
        return request.read("EnumStrings", name)
    if declaration.kind in _LISTS:
        if isinstance(given, (list, tuple)):
            return given
        text = request.read("String", name).strip()
        return re.split(r"[\s,;]+", text) if text else None
    if name not in request.parameters:
        return declaration.default
    if isinstance(given, str):
        try:
            float(given)
        except ValueError:  # parameterAsDouble would silently return the default
            text = mark("{label} must be a number, not {value}.")
            raise Refusal(text, label=declaration.label, value=repr(given)) from None
    # Also for integers as a double, so that 2.5 is refused and does not become 2.
    return request.read("Double", name)
