"""What a page is judged by: axe-core, what moves by itself, what is covered, how a finger hits."""

from __future__ import annotations

from playwright.sync_api import Page

# How much of the window may move by itself while a page comes.
SHIFT_MAX = 0.02
# By the WCAG 2.2 A and AA rules.
JUDGE = """async () => {
    const only = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']
    const found = await axe.run(document, { runOnly: only })
    return found.violations.map((v) => v.id + ': ' + v.nodes.map((n) =>
        n.target.join(' ') + ' ' + n.any.map((a) => a.message).join('; ')).join(' | '))
}"""
# The rows of the window that lie over another one.
COVERED = """() => {
    const rows = [...document.querySelectorAll('.shell > *')].map((row) =>
        [row.className || row.tagName, row.getBoundingClientRect()])
    return rows.flatMap(([name, a], i) => rows.slice(i + 1).flatMap(([other, b]) =>
        Math.min(a.right, b.right) - Math.max(a.left, b.left) > 0.5 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 0.5 ? [[name, other]] : []))
}"""
# What is pressed and is smaller than a finger: WCAG 2.2, 2.5.5. A link in a sentence may be, and
# what belongs to a label is as large as that.
SMALL_TARGETS = """() => [...document.querySelectorAll('button, select, summary, .button, nav a')]
    .filter((node) => node.checkVisibility())
    .map((node) => [node.innerText || node.ariaLabel, node.getBoundingClientRect()])
    .filter(([, box]) => box.width && Math.min(box.width, box.height) < 43.5)
    .map(([name, box]) => [name, box.width, box.height])"""
# What moved by itself while the page came, how much of the window that was, and where from and to.
MOVES = """() => new Promise((told) => {
    const place = ({ y, height }) => `${Math.round(y)}+${Math.round(height)}`
    const name = (node) => node ? (node.className || node.nodeName) + ' ' +
        (node.textContent ?? '').trim().replace(/\\s+/g, ' ').slice(0, 30) : ''
    const moves = []
    const observer = new PerformanceObserver((list) => moves.push(...list.getEntries()))
    observer.observe({ type: 'layout-shift', buffered: true })
    const tell = () => told([...moves, ...observer.takeRecords()]
        .filter((move) => !move.hadRecentInput).map(({ value, sources }) => [value,
            sources.map(({ node, previousRect, currentRect }) =>
                `${name(node)}: ${place(previousRect)} to ${place(currentRect)}`).join('; ')]))
    // What was told before it was observed comes with a task of its own, after the next frame.
    requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(tell)))
})"""


def moved(page: Page) -> list[str]:
    """What moved by itself since the page was loaded, a line each; empty where that is little."""
    moves = page.evaluate(MOVES)
    if sum(share for share, _ in moves) < SHIFT_MAX:
        return []
    return [f"{share:.3f} moved: {what}" for share, what in moves]
