"""Strategies for the fields of settings classes: values from their bounds, and hostile ones."""

from __future__ import annotations

import importlib
import inspect
import math
from dataclasses import MISSING, fields, is_dataclass
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

import numpy as np
from hypothesis import strategies as st

from semnav_features.checked_fields import ANY_NUMBER, Bounds, OneOf
from tests.test_layers import MODULES

VALUES: tuple[Any, ...] = (
    *(math.nan, math.inf, -math.inf, 0, -1, 1, 2, 0.5, -0.0, 5e-324, 1e308, -1e308),
    *(10**400, 10**5000, -(10**400), True, False, None, "", "1", "nan", "x" * 100_000, b"1"),
    *(1 + 2j, [], {}, (), {1}, [1], (1,), (1, 2), (2, 1), (math.nan, 1.0), ((1, 2), (3, 4))),
    *(object(), type, Ellipsis, Decimal("1"), Decimal("nan"), Fraction(1, 3)),
    *(np.float64(0.5), np.float32("nan"), np.int8(3), np.array(1.0), np.array([1.0, 2.0])),
    *(np.datetime64("NaT"), np.ma.masked, range(3), lambda: 1),
)
"""What nobody should give for a field."""


def settings_classes() -> tuple[type, ...]:
    """All dataclasses of the project that check their fields."""
    return tuple(
        kind
        for module in MODULES.values()
        if "check_fields(self)" in module.path.read_text()
        for kind in vars(importlib.import_module(module.name)).values()
        if isinstance(kind, type) and kind.__module__ == module.name and is_dataclass(kind)
        if "check_fields(self)" in inspect.getsource(kind)
    )


def any_of(hint: Any, limits: Any = ANY_NUMBER) -> st.SearchStrategy[Any]:
    """Values as an annotation allows them."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return any_of(*parts)
    if origin in (Union, UnionType):
        return st.one_of(*(any_of(part, limits) for part in parts))
    if origin is tuple:
        each = parts[:1] * 2 if parts[-1] is Ellipsis else parts
        return st.tuples(*(any_of(part, limits) for part in each))
    if isinstance(limits, OneOf):
        return st.sampled_from(limits.choices)
    return _plain(hint, limits)


def _plain(hint: Any, limits: Bounds) -> st.SearchStrategy[Any]:
    if hint is float:
        return st.floats(limits.least, limits.most) | st.sampled_from((limits.least, limits.most))
    if hint is int:
        return st.integers(math.ceil(limits.least), math.floor(limits.most))
    if hint is NoneType:
        return st.none()
    if hint is bool:
        return st.booleans()
    if hint in (str, Path):
        return st.text(max_size=9).map(hint)
    return settings_of(hint) if is_dataclass(hint) else st.nothing()


def settings_of(kind: Any) -> st.SearchStrategy[Any]:
    """Settings of a class that were not refused, most fields as they are by default."""
    return drawn(kind, hostile=False).map(lambda change: constructed(kind, change)).filter(bool)


def drawn(kind: Any, hostile: bool = True) -> st.SearchStrategy[dict[str, Any]]:
    """Up to four fields of a class with drawn values, and those that have no default."""
    hints = get_type_hints(kind, include_extras=True)
    wild = st.sampled_from(VALUES) | st.floats() | st.integers() | st.text(max_size=5)
    values = {
        name: any_of(hint) | wild if hostile else any_of(hint) for name, hint in hints.items()
    }
    needed = {f.name for f in fields(kind) if f.default is f.default_factory is MISSING}
    usual = {name: any_of(hints[name]) for name in needed}
    some = st.lists(st.sampled_from(sorted(values)), max_size=4, unique=True)
    changed = some.flatmap(lambda names: st.fixed_dictionaries({n: values[n] for n in names}))
    return st.builds(lambda base, change: base | change, st.fixed_dictionaries(usual), changed)


def constructed(kind: Any, change: dict[str, Any]) -> Any:
    """The settings, or None if they are refused as they should be: in one short line."""
    try:
        return kind(**change)
    except ValueError as error:
        said = str(error)
    if "\n" in said or len(said) > 400:
        raise AssertionError(f"refused at too great a length: {said[:1000]}")
    return None
