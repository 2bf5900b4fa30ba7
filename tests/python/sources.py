"""Follows the `data-from` of the tables of a page (docs/reference/pages.md) into what it was made from."""

import json
import math
import pathlib
import re
import statistics
from html.parser import HTMLParser

import h5py
import numpy

NUMBER = re.compile(r"[+-]?\d+(\.\d+)?(e[+-]?\d+)?")
# Factors of SI units into those that heads of rows name.
UNITS = {"mm": 1e3, "mrad": 1e3, "cm": 1e2, "cm/s": 1e2, "%": 1e2, "kN": 1e-3, "kN m": 1e-3, "kN s": 1e-3, "kJ": 1e-3, "g": 1 / 9.80665}

PAGES = pathlib.Path(__file__).parents[2] / "docs/reference/pages.md"
# Words that may stand before a path, as the page says it.
WORDS = re.findall("`([^`]+)`", re.search(r"^\| (.*) before it \|", PAGES.read_text(encoding="utf-8"), re.M).group(1))
POINTER = re.compile(r"(/[^/]+)+")
DATASET = re.compile(
    r"[^/\[\]@][^\[\]@]*"
    r"(\[(\w+=(\*|\d+)\+1|(\*|\d+|-1|:)(,(\*|\d+|-1))?)\](\.\w+)?|@\w+)?"
)


def fits(source):
    """Whether a `data-from` is one of those that the page of pages explains."""
    for part in source.split(" / "):
        word, _, path = part.partition(" ")
        if path and re.fullmatch(r"[\w%]+", word):
            if word not in WORDS:
                return False
        else:
            path = part
        if not (POINTER if path.startswith("/") else DATASET).fullmatch(path):
            return False
    return True


class Tables(HTMLParser):
    """Tables of a page: headings of each column with their attributes, and rows of texts."""

    def __init__(self, html):
        super().__init__()
        self.tables, self.cell, self.numbers = [], None, []
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "table":
            self.tables.append({"heads": [], "rows": []})
        elif tag == "tr":
            self.row = {"index": attributes.get("data-row", ""), "cells": []}
        elif tag in ("th", "td"):
            self.cell = {"text": "", **attributes}
        elif tag == "data":
            self.numbers.append({"text": "", **attributes})
            self.number = self.numbers[-1]

    def handle_endtag(self, tag):
        if tag == "tr":
            heads = [c for c in self.row["cells"] if c.get("scope") in ("col", "colgroup")]
            if heads:
                self.tables[-1]["heads"].append(self.row["cells"])
            else:
                self.tables[-1]["rows"].append(self.row)
        elif tag in ("th", "td"):
            self.row["cells"].append(self.cell)
            self.cell = None
        elif tag == "data":
            self.number = None

    number = None

    def handle_data(self, data):
        if self.cell is not None:
            self.cell["text"] += data
        if self.number is not None:
            self.number["text"] += data


def columns(table):
    """The heading of each column, below what spans several."""
    if len(table["heads"]) < 2:
        return table["heads"][0] if table["heads"] else []
    above, below = table["heads"]
    below = iter(below)
    out = []
    for head in above:
        out += [next(below) for _ in range(int(head["colspan"]))] if "colspan" in head else [head]
    return out


class Result:
    """A result file, or the object that a command prints with --json."""

    def __init__(self, path):
        self.json = json.load(open(path)) if str(path).endswith(".json") else None
        self.known = {}
        self.file = None if self.json is not None else h5py.File(path)

    def values(self, path, row):
        """All numbers of a path."""
        if path.startswith("/"):
            return self.pointer(path, row)
        path = path.replace("*", row)
        if "@" in path:
            group, _, attribute = path.rpartition("@")
            return [float(self.file[group].attrs[attribute])]
        data, _, rest = path.partition("[")
        if data not in self.known:
            self.known[data] = self.file[data][()]
        dataset = self.known[data]
        if not rest:
            return [float(x) for x in numpy.ravel(dataset)]
        index, _, column = rest.partition("]")
        if "=" in index:
            name, _, wanted = index.partition("=")
            dataset = dataset[dataset[name] == eval_sum(wanted)]
        else:
            places = (slice(None) if i == ":" else int(i) for i in index.split(","))
            dataset = dataset[tuple(places)]
        if column:
            dataset = dataset[column.lstrip(".")]
        return [float(x) for x in numpy.atleast_1d(dataset)]

    def pointer(self, path, row):
        found = [self.json]
        # What is missing was never there, except in a fit of another kind and in some of many.
        lenient = "+" in path or "/fit/" in path
        for part in path.replace("*", row).split("/")[1:]:
            after = []
            for value in found:
                if value is None:
                    after.append(None)
                elif part == "+":
                    after += value.values() if isinstance(value, dict) else value
                elif isinstance(value, list):
                    after.append(value[int(part)])
                elif lenient:
                    after.append(value.get(part))
                else:
                    after.append(value[part])
            found = after
        return [math.nan if x is None else float(x) for x in found]

    def value(self, source, row):
        """The number of a source: of a path, of two with ` / `, or of a word before one."""
        if " / " in source:
            above, below = (self.value(part, row) for part in source.split(" / "))
            return above / below if below else math.nan
        word, _, path = source.partition(" ")
        if path and word in WORDS:
            known = [x for x in self.values(path, row) if not math.isnan(x)]
            if word == "count":
                return len(self.values(path, row))
            if word == "sum":
                # In a result file no impacts are none; in an answer what is missing is not known.
                return math.fsum(known) if known or not path.startswith("/") else math.nan
            known = [x for x in known if math.isfinite(x)]
            if word == "known":
                return len(known)
            if word == "median":
                return statistics.median(known) if known else math.nan
            if word.endswith("%"):
                return fractile(sorted(known), int(word[:-1]) / 100)
            return {"maximum": max, "minimum": min}[word](known, default=math.nan)
        values = self.values(source, row)
        assert len(values) == 1, f"{source} {row}: {len(values)} numbers"
        return values[0]


def fractile(values, part):
    """A fractile of values in rising order, linear between them."""
    if len(values) < 2:
        return values[0] if values else math.nan
    parts = statistics.quantiles(values, n=100, method="inclusive")
    return parts[round(100 * part) - 1]


def eval_sum(text):
    """`3+1` as it stands in `[level=*+1]`."""
    return sum(int(part) for part in text.split("+"))


# Widths that are asked for: they are rounded up.
REQUIRED = re.compile(
    r"/(required(/by_count|/lognormal/width)?|minimum/width|provisions/.*/records/\+/width|combinations/.*/width/\+/\+"
    r"|readings/.*/width|suite/maximum)$|^maximum /gaps/.*/demand/\+/peak$"
)


def agrees(text, value, source="", row=""):
    """Whether a number was written so that it is the other one of its source in a row, rounded."""
    found = NUMBER.match(text.strip())
    if not found:
        # A force of zero is none.
        return not math.isfinite(value) or value == 0
    shown = found.group()
    mantissa, _, exponent = shown.partition("e")
    digits = len(mantissa.partition(".")[2])
    last = 10.0 ** (int(exponent or 0) - digits)
    # What is divided by such a width is none.
    if " / " not in source and REQUIRED.search(source.replace("*", row)):
        return -1e-6 * last <= float(shown) - value <= last * (1 + 1e-6)
    return abs(float(shown) - value) <= 0.5 * last * (1 + 1e-6) + 1e-12


def factor_of(attribute, head):
    if attribute == "unit":
        unit = re.search(r"\(([^(]*)\)$", head)
        return UNITS.get(unit.group(1), 1.0) if unit else 1.0
    return float(attribute or 1)


def walk(html, result, free=()):
    """Compares every number of every table with its source; how many there were. Columns of
    numbers without a source have one of the headings `free`."""
    parsed = Tables(html)
    seen = 0
    for table in parsed.tables:
        heads = columns(table)
        for row in table["rows"]:
            for head, cell in zip(heads, row["cells"]):
                text = cell["text"]
                source = head.get("data-from")
                if source is None:
                    numeric = re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?( %)?", text)
                    assert not numeric or head["text"] in free, (head, text)
                    continue
                assert fits(source), source
                factor = factor_of(head.get("data-factor"), row["cells"][0]["text"])
                value = factor * result.value(source, row["index"])
                assert agrees(text, value, source, row["index"]), (head, row["index"], text, value)
                seen += 1
    for number in parsed.numbers:
        assert fits(number["data-from"]), number
        factor = float(number.get("data-factor") or 1)
        value = factor * result.value(number["data-from"], "")
        assert agrees(number["text"], value, number["data-from"]), (number, value)
        seen += 1
    return seen
