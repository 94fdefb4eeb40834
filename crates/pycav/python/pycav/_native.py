"""What the compiled part holds, as attributes of the class that wraps it."""

from __future__ import annotations

from typing import Any, Generic, NoReturn, TypeVar, overload

T = TypeVar("T")


class Native(Generic[T]):
    """A read-only attribute that is the wrapped object's of that name, or of the `source` given."""

    def __init__(self, doc: str, source: str | None = None) -> None:
        self.__doc__ = doc
        self._source = source

    def __set_name__(self, owner: type, name: str) -> None:
        self._name, self._source = name, self._source or name

    @overload
    def __get__(self, instance: None, owner: type) -> Native[T]: ...

    @overload
    def __get__(self, instance: object, owner: type) -> T: ...

    def __get__(self, instance: Any, owner: type) -> Any:
        return self if instance is None else getattr(instance._native, str(self._source))

    def __set__(self, instance: object, value: NoReturn) -> None:
        raise AttributeError(f"{self._name} cannot be set")
