"""The page of the Python package in the reference, made from its docstrings.

``python documentation.py`` writes it; a test holds the page that stands there to the docstrings.
"""

from __future__ import annotations

import inspect
import re
from pathlib import Path
from typing import Any

import pounding

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "python.md"
HEAD = """# The Python package

Made from the docstrings by `python crates/python/documentation.py`: change these, not this page.
[How to install and use it](../how-to/use-from-python.md).

"""


def signature(name: str, function: Any) -> str:
    """The call of a function with the types of its arguments, a line each if there are many."""
    made = inspect.signature(function)
    parts, keyword_only = [], False
    for parameter in made.parameters.values():
        if parameter.name in ("self", "cls"):
            continue
        if parameter.kind is parameter.KEYWORD_ONLY and not keyword_only:
            keyword_only = True
            parts.append("*")
        # The types are texts, whose quotes are not shown; those of values are.
        kept = parameter.replace(annotation=parameter.empty)
        typed = "" if parameter.annotation is parameter.empty else f": {parameter.annotation}"
        name_only, equals, value = str(kept).partition("=")
        parts.append(f"{name_only}{typed}" + (f" = {value}" if equals and typed else equals + value))
    returned = made.return_annotation
    tail = "" if returned is inspect.Signature.empty or name[0].isupper() else f" -> {returned}"
    line = f"{name}({', '.join(parts)}){tail}"
    if len(line) > 100:
        line = f"{name}(\n    " + ",\n    ".join(parts) + f",\n){tail}"
    return f"```python\n{line}\n```\n"


def construction(name: str, owner: type) -> str:
    """How an object is made; empty for those that functions return."""
    if issubclass(owner, BaseException):
        return ""
    if "__init__" not in vars(owner):
        return f"```python\n{name}(**keys)\n```\n\n" if issubclass(owner, dict) else ""
    made = inspect.signature(owner.__init__).parameters
    if "native" in made or getattr(owner, "__dataclass_fields__", None):
        return ""
    return signature(name, owner.__init__) + "\n"


def words(text: str) -> str:
    """A docstring as Markdown: headings with a line below them, arguments as lists."""
    lines = inspect.cleandoc(text).splitlines()
    out: list[str] = []
    in_list, number = False, 0
    while number < len(lines):
        line = lines[number]
        below = lines[number + 1] if number + 1 < len(lines) else ""
        if line and re.fullmatch(r"-{3,}", below):
            out += [f"**{line}**", ""]
            in_list, number = True, number + 2
            continue
        if in_list and line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            out.append(f"- `{name}`" + (f" ({kind})" if kind else ""))
        elif in_list and line:
            out.append("  " + line.strip())
        elif line.startswith(">>> "):
            out += ["```python", line.split("#")[0].rstrip()[4:], "```"]
        else:
            out.append(line)
        number += 1
    # Code on lines after one another is one block.
    text = "\n".join(out).replace("```\n```python\n", "")
    text = re.sub(r":\w+:`(?:~)?([^`]+)`", r"`\1`", text)
    return re.sub(r"(?<!`)``(?!`)", "`", text) + "\n"


def documented(owner: type) -> list[tuple[str, Any]]:
    """Properties and methods that a class itself has, in the order of the source."""
    return [
        (name, member)
        for name, member in vars(owner).items()
        if not name.startswith("_")
        and (isinstance(member, (property, classmethod, staticmethod)) or inspect.isfunction(member))
    ]


def page() -> str:
    """The whole page."""
    parts = [HEAD, words(pounding.__doc__ or "")]
    classes = [n for n in pounding.__all__ if inspect.isclass(getattr(pounding, n))]
    functions = [n for n in pounding.__all__ if n not in classes]
    for name in functions:
        function = getattr(pounding, name)
        parts += [f"\n## {name}\n\n", signature(name, function), "\n", words(function.__doc__ or "")]
    for name in classes:
        owner = getattr(pounding, name)
        parts.append(f"\n## {name}\n\n")
        parts.append(construction(name, owner))
        parts.append(words(owner.__doc__ or ""))
        for member_name, member in documented(owner):
            if isinstance(member, property):
                parts += [f"\n### {name}.{member_name}\n\n", words(member.__doc__ or "")]
            else:
                function = member.__func__ if isinstance(member, (classmethod, staticmethod)) else member
                parts += [
                    f"\n### {name}.{member_name}\n\n",
                    signature(member_name, function),
                    "\n",
                    words(member.__doc__ or ""),
                ]
    parts += ["\n## plot\n\n", words(pounding.plot.__doc__ or "")]
    for name in pounding.plot.__all__:
        function = getattr(pounding.plot, name)
        parts += [f"\n### plot.{name}\n\n", signature(name, function), "\n"]
        parts.append(words(function.__doc__ or ""))
    return re.sub(r"\n{3,}", "\n\n", "".join(parts))


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
