"""The names that each table of a file may have, and which of them a misspelt one stands for."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Self

from pydantic import TypeAdapter
from pydantic.errors import PydanticInvalidForJsonSchema

from .meanings import meaning, meanings

CLOSE, _LIKE, _CLOSER = 0.75, 0.6, 0.8  # as of difflib: 1 is equal
LONGEST = 100  # letters of a name that are compared: no known one has half as many

_KINDS = (
    *((bool, ("boolean",)), (int, ("integer", "number")), (float, ("number",))),
    *((str, ("string",)), (list, ("array",)), (dict, ("object",))),
)
_WORDS = {
    **{"object": "a table", "array": "a list", "string": "a text", "boolean": "true or false"},
    **{"number": "a number", "integer": "a whole number"},
}

Place = tuple[str | int, ...]


@dataclass(frozen=True)
class Names:
    """Names that a file may have, by the JSON schema of its content."""

    schema: Mapping[str, Any]

    @classmethod
    @lru_cache(maxsize=8)
    def of(cls, adapter: TypeAdapter) -> Self:
        """Names of the content that an adapter reads."""
        try:
            return cls(adapter.json_schema())
        except PydanticInvalidForJsonSchema:  # of types whose names nothing tells
            return cls({})

    def at(self, where: Place, content: Any) -> list[str]:
        """Names of a table of the content; none of what is no table, or of unknown type."""
        return list(self._table(where, content))

    def meant(self, where: Place, value: Any, content: Any) -> Place | None:
        """The place that a name at a place was probably meant for; None where nothing is like it.

        Looked for among what is not stated yet and may have such a value: in the same table, then in others; by
        its meaning, then by its letters.
        """
        inside, name = list(where[:-1]), str(where[-1])
        stated, table = _of(content, inside), self._table(tuple(inside), content)
        fit = [
            known
            for known, child in table.items()
            if known not in stated and _fits(self._node(child, value), value)
        ]
        away = [
            place
            for place, node in self._unstated((), self.schema, content)
            if list(place[:-1]) != inside and _fits(self._node(node, value), value)
        ]
        if (here := meaning(name, table)) is not None:
            field = here.field(fit)
            return None if here.says or field is None else (*inside, field)
        if (close := nearest(name, table, CLOSE)) in stated:
            return None
        called = {str(place[-1]): place for place in reversed(away)}
        if close in fit:
            return (*inside, close)
        if name in called:
            return called[name]
        if there := [field for each in meanings(name) if not each.says and (field := each.field(called))]:
            return called[there[0]]
        if close is None and (like := nearest(name, fit, _LIKE)) is not None:
            return (*inside, like)
        return called.get(nearest(name, called, _CLOSER) or "")

    def takes(self, where: Place, content: Any) -> str:
        """What a name at a place takes, in words."""
        node = self._node(self._table(where[:-1], content)[str(where[-1])], {})
        return _WORDS.get(str(node.get("type")), "other values")

    def instead(self, where: Place, content: Any) -> list[str]:
        """Names of which one may stand in place of that at a place, as a Young's modulus for a shear modulus."""
        table = self._schema(where[:-1], content)
        ways = [each.get("oneOf") or each.get("anyOf") or [] for each in (table, *table.get("allOf", ()))]
        needed = [[each.get("required", []) for each in way] for way in ways]
        return [name for way in needed if [where[-1]] in way for name, *_ in way if name != where[-1]]

    def _table(self, where: Place, content) -> Mapping[str, Any]:
        return self._schema(where, content).get("properties", {})

    def _schema(self, where: Place, content) -> Mapping[str, Any]:
        node = self._node(self.schema, content)
        for part in where:
            content = _part(content, part)
            node = self._node(_child(node, part), content)
        return node

    def _unstated(self, where: Place, node, content) -> Iterator[tuple[Place, Mapping]]:
        """Names that tables could have besides; tables in lists are left out."""
        for name, child in self._node(node, content).get("properties", {}).items():
            value = _part(content, name)
            if value is None:
                # A table that is not there, one without types: it would be one name in it.
                yield (*where, name), child
            if value is None or isinstance(value, dict):
                yield from self._unstated((*where, name), child, value or {})

    def _node(self, node, content) -> Mapping:
        """The schema of a part, once references are followed and the type of a table has decided."""
        if "$ref" in node:
            return self._node(self.schema["$defs"][node["$ref"].rpartition("/")[2]], content)
        if "discriminator" in node:
            mapping, kind = node["discriminator"]["mapping"], _part(content, "type")
            if not isinstance(kind, str) or kind not in mapping:
                return {"type": "object"}
            return self._node({"$ref": mapping[kind]}, content)
        # Choices beside names say which of them go together.
        if "properties" not in node and (choices := node.get("anyOf") or node.get("oneOf")):
            every = [self._node(each, content) for each in choices]
            return next((each for each in every if each.get("type") in _kinds(content)), every[0])
        return node


def nearest(name: str, known: Iterable[str], cutoff: float = _LIKE) -> str | None:
    """The known name that one is most like; None where none is."""
    # Only mistakes need it.
    from difflib import get_close_matches

    plain = {each.lower().replace("_", "-"): each for each in reversed(list(known))}
    found = get_close_matches(name[:LONGEST].lower().replace("_", "-"), plain, n=1, cutoff=cutoff)
    return plain[found[0]] if found else None


def _fits(node, value):
    """Whether a table, a list, a text or a number is where there may be one."""
    return node["type"] in _kinds(value) if "type" in node else not isinstance(value, dict | list)


def _kinds(value):
    """What JSON calls a value."""
    return next((kinds for kind, kinds in _KINDS if isinstance(value, kind)), ())


def _child(node, part):
    if isinstance(part, int):
        return node.get("items") or {}
    return node.get("properties", {}).get(part) or {}


def _part(content, part):
    try:
        return content[part]
    except (LookupError, TypeError):
        return None


def _of(content, inside):
    for part in inside:
        content = _part(content, part)
    return content if isinstance(content, dict) else {}
