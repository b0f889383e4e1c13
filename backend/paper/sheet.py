"""Sheets of paper: size, margins, what stands at the foot of each, page x of y; and any text in the
fonts there are, as markup of a paragraph.

Latin, Greek and Cyrillic come in Source Sans, embedded as far as used. Chinese is named, not
embedded: STSong-Light is one of the fonts that PDF leaves to the reader (ISO 32000-1, 9.7.5.2),
and the characters themselves are in the file. What neither has stands as its code point.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import chain, groupby
from typing import Any, Literal
from xml.sax.saxutils import escape

from reportlab.lib import colors
from reportlab.lib.enums import TA_RIGHT
from reportlab.lib.pagesizes import A4, LETTER
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfbase.pdfmetrics import registerFont, registerFontFamily, stringWidth
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    CondPageBreak,
    KeepTogether,
    Paragraph,
    SimpleDocTemplate,
    Spacer,
    Table,
)

LATIN, LATIN_BOLD, CHINESE = "SourceSans", "SourceSans-Bold", "STSong-Light"
FILES = {LATIN: "SourceSansPro-Regular.ttf", LATIN_BOLD: "SourceSansPro-Semibold.ttf"}


@cache
def latin_letters() -> frozenset[int]:
    """The code points of the embedded font. Makes all fonts known, once."""
    registerFont(UnicodeCIDFont(CHINESE))
    folder = files("font_source_sans_pro") / "files"
    for name, file in FILES.items():
        with (folder / file).open("rb") as data:
            font = TTFont(name, data)
        registerFont(font)
    registerFontFamily(LATIN, normal=LATIN, bold=LATIN_BOLD, italic=LATIN, boldItalic=LATIN_BOLD)
    return frozenset(font.face.charToGlyph)


def runs(text: str, latin: str = LATIN) -> list[tuple[str, str]]:
    """A line of text as (font, letters) one after the other."""
    letters = [_letter(one, latin) for one in " ".join(text.split())]
    return [
        (font, "".join(letter for _, letter in run))
        for font, run in groupby(letters, key=lambda one: one[0])
    ]


def marked(text: str, latin: str = LATIN) -> str:
    """A line of text as a paragraph's markup: nothing in it is markup itself."""
    return "".join(f'<font name="{font}">{escape(run)}</font>' for font, run in runs(text, latin))


def width_of(text: str, size: float) -> float:
    """In points."""
    return float(sum(stringWidth(run, font, size) for font, run in runs(text)))


def _letter(one: str, latin: str) -> tuple[str, str]:
    if not one.isprintable():
        return latin, f"[U+{ord(one):04X}]"
    if ord(one) in latin_letters():
        return latin, one
    try:
        one.encode("gbk")
    except UnicodeEncodeError:
        return latin, f"[U+{ord(one):04X}]"
    return CHINESE, one


Paper = Literal["a4", "letter"]
SIZES: dict[Paper, tuple[float, float]] = {"a4": A4, "letter": LETTER}
MARGIN, FOOT = 15 * mm, 17 * mm
FRAME = 6  # what reportlab keeps free inside its margins
HEAD_WITH = 28 * mm  # what is below a heading on its page, at least
TEXT, SMALL = 8.5, 7.2
SIGN_HIGH = 14 * mm

INK, QUIET, LINE = (colors.HexColor(one) for one in ("#10201d", "#4a5753", "#b9c4c0"))
OK, WARN, BAD = (colors.HexColor(one) for one in ("#00795a", "#8a5300", "#b3261e"))


@dataclass(frozen=True)
class Cover:
    """What a document says of itself. foot: at the left of every page's foot. pages: `Page {page}
    of {pages}` in its language, which `language` names."""

    title: str
    author: str
    foot: str
    pages: str
    language: str
    paper: Paper


def width_on(paper: Paper) -> float:
    """Between the margins, in points."""
    return float(SIZES[paper][0] - 2 * MARGIN)


def printed(cover: Cover, parts: Sequence[Any]) -> bytes:
    """The file. The same bytes for the same parts: it tells no time of its own."""
    latin_letters()
    data = io.BytesIO()
    document = SimpleDocTemplate(
        data,
        pagesize=SIZES[cover.paper],
        leftMargin=MARGIN - FRAME,
        rightMargin=MARGIN - FRAME,
        topMargin=MARGIN,
        bottomMargin=FOOT,
        title=cover.title,
        author=cover.author,
        lang=cover.language,
        invariant=1,
    )
    document.build(list(parts), canvasmaker=lambda *a, **k: _Numbered(cover, *a, **k))
    return data.getvalue()


class _Numbered(Canvas):  # type: ignore[misc]  # reportlab tells no types
    """Holds its pages back until their number is known."""

    def __init__(self, cover: Cover, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._cover = cover
        self._pages: list[dict[str, Any]] = []

    def showPage(self) -> None:
        """Called by reportlab at the end of each."""
        self._pages.append(dict(self.__dict__))
        self._startPage()

    def save(self) -> None:
        """Called by reportlab at the end of all."""
        for number, page in enumerate(self._pages, 1):
            self.__dict__.update(page)
            footer = self._cover.pages.format(page=number, pages=len(self._pages))
            right = self._pagesize[0] - MARGIN
            self.setStrokeColor(LINE)
            self.line(MARGIN, FOOT - 8, right, FOOT - 8)
            self.setFillColor(QUIET)
            write(self, MARGIN, FOOT - 18, self._cover.foot, SMALL)
            write(self, right, FOOT - 18, footer, SMALL, anchor=1.0)
            super().showPage()
        super().save()


def write(canvas: Canvas, x: float, y: float, text: str, size: float, anchor: float = 0.0) -> None:
    """A line at a place. anchor: 0 begins there, 0.5 is centred, 1 ends there."""
    x -= anchor * width_of(text, size)
    for font, run in runs(text):
        canvas.setFont(font, size)
        canvas.drawString(x, y, run)
        x += canvas.stringWidth(run, font, size)


def text(
    words: str,
    size: float = TEXT,
    colour: Any = INK,
    *,
    bold: bool = False,
    right: bool = False,
    below: float = 0,
) -> Paragraph:
    """Words that wrap, also within a word that is too long."""
    style = ParagraphStyle(
        "text",
        fontName=LATIN,
        fontSize=size,
        leading=1.25 * size,
        textColor=colour,
        spaceAfter=below,
        alignment=TA_RIGHT if right else 0,
        wordWrap="CJK" if any(ord(one) > 0x2E7F for one in words) else None,
        splitLongWords=1,
    )
    return Paragraph(marked(words, LATIN_BOLD if bold else LATIN), style)


def section(title: str, *parts: Any) -> list[Any]:
    """A heading that is not left alone at the end of a page."""
    return [CondPageBreak(HEAD_WITH), Spacer(0, 7), text(title, 11, bold=True, below=3), *parts]


def table(
    rows: Sequence[Sequence[Any]], widths: Sequence[float], numbers: Sequence[int] = ()
) -> Table:
    """rows: the first is the head, and repeats on every page. widths: shares of the sheet.
    numbers: which columns stand at the right. A cell is words or a part."""
    cells = [
        [
            one if not isinstance(one, str) else _cell(one, row == 0, column in numbers)
            for column, one in enumerate(line)
        ]
        for row, line in enumerate(rows)
    ]
    made = Table(cells, colWidths=list(widths), repeatRows=1, hAlign="LEFT")
    made.setStyle(
        [
            ("LINEBELOW", (0, 0), (-1, 0), 0.8, INK),
            ("LINEBELOW", (0, 1), (-1, -1), 0.3, LINE),
            *_PADDING,
        ]
    )
    return made


def facts(pairs: Sequence[tuple[str, str]], width: float, columns: int = 2) -> Table:
    """Names with their values, in columns beside each other."""
    share = width / columns
    cells = [[text(name, SMALL, QUIET), text(value or "—")] for name, value in pairs]
    cells += [["", ""]] * (-len(cells) % columns)
    rows = [[*chain(*cells[at : at + columns])] for at in range(0, len(cells), columns)]
    made = Table(rows, colWidths=[0.3 * share, 0.7 * share] * columns, hAlign="LEFT")
    made.setStyle([*_PADDING])
    return made


def side_by_side(parts: Sequence[Any], width: float) -> Table:
    """Parts next to each other, equally wide."""
    made = Table([list(parts)], colWidths=[width / len(parts)] * len(parts), hAlign="LEFT")
    made.setStyle([*_PADDING])
    return made


def signatures(who: Sequence[str], width: float) -> Table:
    """A line for each to sign on."""
    gap = 0.06 * width
    share = (width - gap * (len(who) - 1)) / len(who)
    row: list[Any] = []
    widths: list[float] = []
    styles = []
    for place, one in enumerate(who):
        if place:
            row.append("")
            widths.append(gap)
        styles.append(("LINEABOVE", (len(row), 1), (len(row), 1), 0.6, INK))
        row.append(text(one, SMALL, QUIET))
        widths.append(share)
    made = Table([[""] * len(row), row], widths, [SIGN_HIGH, None], hAlign="LEFT")
    made.setStyle([*_PADDING, *styles])
    return made


def together(*parts: Any) -> KeepTogether:
    """Parts that stay on one page."""
    return KeepTogether(list(parts))


def _cell(words: str, head: bool, right: bool) -> Paragraph:
    return text(words, SMALL if head else TEXT, QUIET if head else INK, right=right)


_PADDING = [
    ("VALIGN", (0, 0), (-1, -1), "TOP"),
    ("LEFTPADDING", (0, 0), (-1, -1), 0),
    ("RIGHTPADDING", (0, 0), (-1, -1), 5),
    ("TOPPADDING", (0, 0), (-1, -1), 1.2),
    ("BOTTOMPADDING", (0, 0), (-1, -1), 1.8),
]
