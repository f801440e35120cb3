"""JSON schemas of the files that a user writes, for editors, and of what commands print for programs."""

import json
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter
from pydantic.json_schema import GenerateJsonSchema

from ..solving.folders import write
from ..solving.suggest import known
from ..solving.vocabulary import documented

DIALECT = "https://json-schema.org/draft/2020-12/schema"
KINDS = {
    "scene": "Scene file of crosscheck run and plan",
    "study": "Study file of crosscheck study",
    "answers": "What the option --json prints",
}
# Bounds of a list, where pydantic does not see that it is one.
_ITEMS = {"minLength": "minItems", "maxLength": "maxItems"}
_BOUNDS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}


def schema(kind: str, output: str | Path | None = None) -> dict[str, Any]:
    """JSON schema, draft 2020-12, of "scene" or "study" files, or of "answers". Raises InvalidInput of others.

    output : file that it is written into; none if absent
    """
    known("KIND", kind, KINDS)
    if kind == "answers":
        from .answers import Answer

        found = TypeAdapter(Answer).json_schema(mode="serialization", schema_generator=_Answers)
    else:
        # Only the schema itself needs what it describes.
        from ..library.case import Case
        from .comparison.study_file import StudyFile

        what = {"scene": Case, "study": StudyFile}[kind]
        found = _with_bounds(TypeAdapter(what).json_schema(schema_generator=_Documented))
    made = {"$schema": DIALECT, **found, "title": KINDS[kind]}
    if output is not None:
        text = json.dumps(made, indent=1, ensure_ascii=False)
        write(Path(output), lambda file: file.write(f"{text}\n".encode()))
    return made


class _Documented(GenerateJsonSchema):
    """Schema with the docstrings of each class and its fields, and with types stated where they decide."""

    def dataclass_schema(self, schema):
        found = super().dataclass_schema(schema)
        about, fields = documented(schema["cls"].__doc__)
        for name, text in fields.items():
            if name in found.get("properties", {}):
                described = found["properties"][name]
                allowed = described.get("description")
                found["properties"][name] = described | {"description": f"{text}: {allowed}" if allowed else text}
        return found | ({"description": about} if about else {})

    def tagged_union_schema(self, schema):
        found = super().tagged_union_schema(schema)
        if found.pop("discriminator", None) is not None:  # of OpenAPI, and no part of JSON schema
            for part in (self.get_schema_from_definitions(choice["$ref"]) for choice in found["oneOf"]):
                part["required"] = list(dict.fromkeys(["type", *part.get("required", [])]))
        return found


class _Answers(_Documented):
    """Schema of what is printed: nothing else stands there, and null for a number not known or not finite."""

    def dataclass_schema(self, schema):
        return super().dataclass_schema(schema) | {"additionalProperties": False}

    def float_schema(self, schema):
        return {"type": ["number", "null"]}


def _with_bounds(node):
    """A schema with bounds by their names in JSON schema."""
    if isinstance(node, list):
        return [_with_bounds(each) for each in node]
    if not isinstance(node, dict):
        return node
    names = _BOUNDS | (_ITEMS if node.get("type") == "array" else {})
    return {
        name if isinstance(value, dict) else names.get(name, name): _with_bounds(value)
        for name, value in node.items()
    }
