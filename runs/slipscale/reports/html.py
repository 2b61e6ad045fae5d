"""What pages are made of: one file of HTML with its style and pictures inside."""

import base64
import html
import io
import mimetypes

from slipscale.running.attempt import write_whole

STYLE = """
:root { color-scheme: light; --ink: #1c2430; --soft: #5b6675; --line: #dde2e8; --paper: #fff; --tint: #f5f7f9; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 2rem 1.5rem 4rem; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem; }
p.lead { color: var(--soft); margin: 0 0 1.5rem; } img { max-width: 100%; height: auto; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: .8rem; margin: 1rem 0 1.5rem;
}
.card { background: var(--tint); border: 1px solid var(--line); border-radius: 6px; padding: .6rem .8rem; }
.card b { display: block; font-size: 1.25rem; font-weight: 600; } .card span { color: var(--soft); font-size: .85rem; }
table { border-collapse: collapse; font-size: .9rem; } td, th { padding: .22rem .8rem .22rem 0; text-align: left;
  border-bottom: 1px solid var(--line); vertical-align: top; } td.value { font-variant-numeric: tabular-nums; }
td.note, th { color: var(--soft); font-weight: 400; } tr.group td { font-weight: 600; padding-top: .8rem; }
.warning { border-left: 4px solid #c8501e; background: #fdf3ee; padding: .5rem .9rem; margin: .5rem 0; }
pre, code { font: .85rem/1.5 ui-monospace, monospace; } pre { background: var(--tint); border: 1px solid var(--line);
  padding: .7rem .9rem; overflow-x: auto; border-radius: 6px; }
.columns { columns: 2 24rem; column-gap: 3rem; } .scroll { overflow-x: auto; }
footer { color: var(--soft); font-size: .85rem; margin-top: 3rem; border-top: 1px solid var(--line);
  padding-top: .6rem; }
"""


def text(value):
    return html.escape(str(value))


def document(title, body, foot=""):
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{text(title)}</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n<main>\n{body}\n<footer>{text(foot)}</footer>\n</main>\n"
            "</body>\n</html>\n")


def section(heading, body):
    return f"<h2>{text(heading)}</h2>\n{body}\n" if body else ""


def cards(entries):
    """Of (number, what it is), both texts."""
    inner = "".join(f'<div class="card"><b>{text(number)}</b><span>{text(what)}</span></div>\n'
                    for number, what in entries)
    return f'<div class="cards">\n{inner}</div>'


def table(rows, heading=()):
    """Rows of texts; a row of one text heads a group."""
    lines = []
    if heading:
        lines.append("<tr>" + "".join(f"<th>{text(cell)}</th>" for cell in heading) + "</tr>")
    for row in rows:
        if len(row) == 1:
            lines.append(f'<tr class="group"><td colspan="9">{text(row[0])}</td></tr>')
        else:
            kinds = ["", ' class="value"'] + [' class="note"'] * len(row)
            lines.append("<tr>" + "".join(f"<td{kind}>{text(cell)}</td>" for kind, cell in zip(kinds, row)) + "</tr>")
    return '<div class="scroll"><table>\n' + "\n".join(lines) + "\n</table></div>" if rows else ""


def warnings(sentences):
    return "".join(f'<div class="warning">{text(sentence)}</div>\n' for sentence in sentences)


def embedded(data, kind):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def image(path, caption=""):
    kind = mimetypes.guess_type(str(path))[0] or "image/png"
    return f'<img alt="{text(caption or path.name)}" src="{embedded(path.read_bytes(), kind)}">'


def figure(drawn, caption):
    """A figure of matplotlib."""
    buffer = io.BytesIO()
    drawn.savefig(buffer, format="png", dpi=110)
    return f'<img alt="{text(caption)}" src="{embedded(buffer.getvalue(), "image/png")}">'


def write(path, page):
    write_whole(path, page)
