"""What a person reads whose browser opens a page that is refused: words, not an empty window.

Programs and scripts get the same refusal as a problem. Nothing is fetched for it: the addresses of
files may be what is wrong.
"""

from __future__ import annotations

from html import escape

from fastapi.responses import HTMLResponse

DOCS = "docs/behind-a-proxy.md"
# By code; the English words are the refusal's own.
CHINESE = {
    "foreign_host": "此服务器不叫这个名称（Host）。请用 localhost 或其 IP 地址打开，"
    "或将该名称写入 SPINDLE_ALLOWED_HOSTS。",
    "passed_on": "此请求由代理转发，而此服务器对任何能访问它的人开放。请设置 SPINDLE_AUTH=required "
    "要求登录；若代理只放行您认识的人，可设置 SPINDLE_AUTH=off。",
    "foreign_origin": "其他来源（Origin）的页面不得使用此服务器。若在代理之后，"
    "代理须原样传递浏览器所用的名称（Host）。",
}
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Spindle: {code}</title>
<meta name="viewport" content="width=device-width"><meta name="color-scheme" content="light dark">
<body style="font: 16px/1.5 system-ui; max-width: 40rem; margin: 4rem auto; padding: 0 1rem">
<h1>Spindle does not answer this way</h1><p>{detail}</p><p>Behind a proxy: {docs}</p>
<div lang="zh-CN"><h2>Spindle 未接受此访问</h2><p>{chinese}</p><p>代理设置见 {docs}</p></div>
<p><code>{code}</code></p>
"""


def refused_page(status: int, code: str, detail: str) -> HTMLResponse:
    """The refusal as a page of both languages. code: one of CHINESE; detail: the English words."""
    page = PAGE.format(
        code=code, detail=escape(detail), chinese=escape(CHINESE[code]), docs=escape(DOCS)
    )
    return HTMLResponse(page, status)
