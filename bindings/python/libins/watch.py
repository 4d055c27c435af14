"""Expressions of C over the board's memory: names and types from the .cdb, registers, SFRs, places in memory.

    total + table[1] * 3        node->next->content[0].word     &buffer[2]      *pointer == 0x30 && !flag
    P1          TCON.5          a special function register, a bit of anything
    $pc $sp $a $b $dptr $r0 .. $r7 $psw $cycle $time            registers, machine cycles, seconds
    iram:0x30   xdata:0x100     an octet of a memory: iram, sfr, xdata, code

Whole numbers are computed without bounds, as Python does; division is C's, towards zero.
"""

import operator
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from libins import disasm
from libins.cdb import Cdb
from libins.cdb_types import CdbError, Kind, Type
from libins.places import (
    BYTE,
    INT,
    MEMORIES,
    ExpressionError,
    Memory,
    Number,
    Place,
    Value,
    bank,
    decayed,
    located,
    pointed,
    pointer,
)

NESTING_MAX = 32
TOKENS_MAX = 256
Node = Callable[[Memory], Value]
_TOKEN = re.compile(
    r"\s*(?:(?P<number>0[xX][0-9a-fA-F]+|0[bB][01]+|\d+\.\d+(?:[eE][+-]?\d+)?|\d+)[uUlL]*|(?P<char>'(?:[^'\\]|\\.)')"
    r"|(?P<name>[A-Za-z_]\w*)|(?P<register>\$\w+)|(?P<mark>->|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^~!<>()\[\].:]))"
)
_LEVELS: tuple[dict[str, Callable[[Any, Any], Any]], ...] = (
    {"||": lambda a, b: int(bool(a) or bool(b))},
    {"&&": lambda a, b: int(bool(a) and bool(b))},
    {"|": operator.or_},
    {"^": operator.xor},
    {"&": operator.and_},
    {"==": lambda a, b: int(a == b), "!=": lambda a, b: int(a != b)},
    {"<": lambda a, b: int(a < b), "<=": lambda a, b: int(a <= b)}
    | {">": lambda a, b: int(a > b), ">=": lambda a, b: int(a >= b)},
    {"<<": lambda a, b: a << min(b, 64), ">>": operator.rshift},
    {"+": operator.add, "-": operator.sub},
    {"*": operator.mul, "/": lambda a, b: _divide(a, b), "%": lambda a, b: a - b * _divide(a, b)},
)
_UNARY: dict[str, Callable[[Any], Any]] = {"-": operator.neg, "~": operator.inv, "!": lambda x: int(not x)}
_ESCAPES = {"n": 10, "r": 13, "t": 9, "0": 0, "\\": 92, "'": 39}


def _divide(a: Number, b: Number) -> Number:
    if isinstance(a, float) or isinstance(b, float):
        return a / b
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


class Expression:
    """One expression, its names bound as the code at an address sees them. Raises ExpressionError."""

    def __init__(self, text: str, table: Cdb | None, pc: int | None = None) -> None:
        """`table`: the program's names; without, registers and memories only."""
        self.text = text.strip()
        self._table, self._pc = table, pc
        self._tokens = self._split(text)
        self._at = 0
        self._depth = 0
        self._node = self._binary(0)
        if self._at < len(self._tokens):
            raise self._error(f"{self._tokens[self._at][1]!r} cannot follow here")

    def value(self, memory: Memory) -> Value:
        """Evaluate. Raises ExpressionError."""
        try:
            return self._node(memory)
        except (ZeroDivisionError, TypeError, ValueError, OverflowError) as error:
            raise ExpressionError(f"{self.text}: {error}") from error

    def number(self, memory: Memory) -> Number:
        """Evaluate to a number. Raises ExpressionError."""
        return memory.number(self.value(memory))

    def _error(self, what: str) -> ExpressionError:
        return ExpressionError(f"{self.text!r}: {what}")

    def _split(self, text: str) -> list[tuple[str, str]]:
        tokens, at, text = [], 0, text.rstrip()
        while at < len(text):
            m = _TOKEN.match(text, at)
            if m is None or m.lastgroup is None:
                raise self._error(f"{text[at:].strip()[:10]!r} is no C")
            tokens.append((m.lastgroup, m[m.lastgroup]))
            at = m.end()
        if len(tokens) > TOKENS_MAX:
            raise self._error(f"longer than {TOKENS_MAX} words")
        return tokens

    def _peek(self) -> str:
        return self._tokens[self._at][1] if self._at < len(self._tokens) else ""

    def _take(self, wanted: str = "") -> tuple[str, str]:
        if self._at >= len(self._tokens) or (wanted and self._peek() != wanted):
            found = repr(self._peek()) if self._peek() else "the end"
            raise self._error(f"found {found}, but {wanted or 'a value'} is needed")
        self._at += 1
        return self._tokens[self._at - 1]

    def _binary(self, level: int) -> Node:
        if level == len(_LEVELS):
            return self._unary()
        left = self._binary(level + 1)
        while self._peek() in _LEVELS[level]:
            name = self._take()[1]
            left = self._joined(name, left, self._binary(level + 1))
        return left

    def _joined(self, name: str, left: Node, right: Node) -> Node:
        join = next(level[name] for level in _LEVELS if name in level)

        def node(memory: Memory) -> Value:
            a = decayed(left(memory)) if name in "+-" else left(memory)
            first = memory.number(a)
            if name in ("&&", "||") and bool(first) == (name == "||"):
                return Value(INT, int(bool(first)))
            moves = name in "+-" and a.type.kind is Kind.POINTER and a.type.target is not None
            scale = a.type.target.size if moves and a.type.target is not None else 1
            number = join(first, memory.number(right(memory)) * scale)
            if moves:
                return Value(a.type, number, module=a.module)
            return Value(INT if isinstance(number, int) else Type(Kind.FLOAT, 4), number)

        return node

    def _unary(self) -> Node:
        self._depth += 1
        if self._depth > NESTING_MAX:
            raise self._error(f"more than {NESTING_MAX} levels deep")
        try:
            mark = self._peek()
            if mark not in ("-", "~", "!", "*", "&"):
                return self._postfix()
            self._take()
            operand = self._unary()
        finally:
            self._depth -= 1
        if mark == "*":
            return lambda memory: pointed(operand(memory), 0, self._table, memory)
        if mark == "&":
            return lambda memory: self._address(operand(memory))
        change = _UNARY[mark]
        return lambda memory: Value(INT, change(memory.number(operand(memory))))

    def _address(self, value: Value) -> Value:
        if value.place is None or value.place.registers or value.type.bits is not None:
            raise self._error("has no address")
        return Value(pointer(value.type, value.place), value.place.address, module=value.module)

    def _postfix(self) -> Node:
        node = self._primary()
        while self._peek() in ("[", ".", "->"):
            mark = self._take()[1]
            if mark == "[":
                index = self._binary(0)
                self._take("]")
                node = self._indexed(node, index)
            else:
                kind, name = self._take()
                if kind not in ("name", "number"):
                    raise self._error(f"found {name!r}, but a member or a bit is needed")
                node = self._member(node, name, mark == "->")
        return node

    def _indexed(self, node: Node, index: Node) -> Node:
        return lambda memory: pointed(node(memory), int(memory.number(index(memory))), self._table, memory)

    def _member(self, node: Node, name: str, through: bool) -> Node:
        def member(memory: Memory) -> Value:
            value = pointed(node(memory), 0, self._table, memory) if through else node(memory)
            place = value.place
            if (
                name.isdigit()
                and value.type.kind is Kind.INTEGER
                and place is not None
                and int(name) < 8 * value.type.size
            ):
                return replace(value, type=replace(value.type, signed=False, bits=(int(name), 1)))
            if value.type.kind is Kind.STRUCT and place is not None and self._table is not None:
                for each in self._table.members(value.module, value.type):
                    if each.name == name:
                        there = replace(place, address=place.address + each.offset)
                        return Value(each.type, place=there, module=value.module)
            raise self._error(f"{value.type} has no member {name}")

        return member

    def _primary(self) -> Node:
        kind, text = self._take()
        if kind == "number":
            number = float(text) if "." in text else int(text, 0) if not text.isdigit() else int(text)
            constant = Value(Type(Kind.FLOAT, 4) if isinstance(number, float) else INT, number)
            return lambda memory: constant
        if kind == "char":
            code = Value(INT, _ESCAPES.get(text[2], ord(text[2])) if text[1] == "\\" else ord(text[1]))
            return lambda memory: code
        if text == "(":
            node = self._binary(0)
            self._take(")")
            return node
        if kind == "register":
            return self._register(text[1:].lower())
        if kind != "name":
            raise self._error(f"found {text!r}, but a value is needed")
        if text in MEMORIES and self._peek() == ":":
            self._take()
            number_of = self._primary()
            return lambda memory: Value(BYTE, place=Place(text, int(memory.number(number_of(memory))) & 0xFFFF))
        return self._name(text)

    def _register(self, name: str) -> Node:
        octets = {"a": "ACC", "acc": "ACC", "b": "B", "psw": "PSW", "sp": "SP", "dpl": "DPL", "dph": "DPH"}
        if name in octets:
            place = Value(BYTE, place=Place("sfr", disasm.SFR[octets[name]]))
            return lambda memory: place
        if name == "dptr":
            dptr = Value(Type(Kind.INTEGER, 2), place=Place("sfr", disasm.SFR["DPL"]))
            return lambda memory: dptr
        if name == "cy":
            carry = Value(replace(BYTE, bits=(7, 1)), place=Place("sfr", disasm.SFR["PSW"]))
            return lambda memory: carry
        if re.fullmatch(r"r[0-7]", name):
            return lambda memory: Value(BYTE, place=Place("iram", bank(memory) + int(name[1])))
        readers: dict[str, Callable[[Any], Number]] = {
            "pc": lambda run: run.pc,
            "cycle": lambda run: run.cycle,
            "time": lambda run: run.now_ps * 1e-12,
        }
        if name not in readers:
            raise self._error(f"no register ${name}; $pc $sp $a $b $dptr $psw $cy $r0 .. $r7 $cycle $time are")
        return lambda memory: Value(INT, readers[name](memory.run))

    def _name(self, name: str) -> Node:
        if self._table is not None:
            for function in self._table.functions:
                if function.name == name:
                    code = Value(function.type, place=Place("code", function.begin), module=function.module)
                    return lambda memory: code
            try:
                symbol = self._table.find(name, self._pc)
            except CdbError as error:
                if name not in disasm.SFR:
                    raise self._error(str(error)) from error
            else:
                return lambda memory: located(symbol, self._table, memory)
        if name not in disasm.SFR:
            raise self._error(f"no C names here: no .cdb beside the image; build it with sdcc --debug ({name})")
        place = Value(BYTE, place=Place("sfr", disasm.SFR[name]))
        return lambda memory: place
