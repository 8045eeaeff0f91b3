"""docs/gallery.md: a table, and a section a package."""

HEAD = """# What real packages compute

What volver says of public packages, each at the version that is pinned, driven through its public interface by a kernel of about 40 lines in [`gallery`](../gallery/README.md). A guess was written down before the kernel's last form, or says that it came later; few were blind, since some of these packages had been driven before. Then the package was asked, and its source was read by hand, in a copy of its repository where the wheel has none, unless the row says otherwise. Where a row has levels of its own for gradients, they were chosen when the usual ones had shown no order. `make gallery` installs each and asks it again; this page is made of `row.toml` and `expected.json` in its folder.

A kernel declares what one would guess, so that the deviations are those from the guess; [their names](identify.md#deviations) and [the verdicts](verdicts.md) have pages of their own. *Confirmed* counts channels of the catalogue's cases in which the order shows. A formula was held out against rays that it was not found with: how many of them it predicts to the digits of the package's format stands beside it. A formula says what was computed on rays of the kinds that were asked, through that kernel, and no more.
"""


def written(rows):
    """The whole page."""
    parts = [HEAD, _table(rows)]
    kind = None
    for row in rows:
        if row.kind != kind:
            kind = row.kind
            parts.append(f"## {kind[0].upper()}{kind[1:]}\n")
        parts.append(_section(row))
    return "\n".join(parts)


def _table(rows):
    lines = ["| package | what | order | deviates from the guess in | gradients |", "|---|---|---|---|---|"]
    for row in rows:
        found = row.expected()
        name = f"[{row.name}](#{_anchor(row)})"
        if row.why_not:
            lines.append(f"| {name} | {_cell(row.what)} | not driven | – | – |")
        elif found is None:
            lines.append(f"| {name} | {_cell(row.what)} | not run yet | – | – |")
        else:
            gradients = found.get("gradients", {}).get("conclusion", "–")
            lines.append(f"| {name} | {_cell(row.what)} | {_orders(found)} | {_deviations(found)} | {gradients} |")
    return "\n".join(lines) + "\n"


def _section(row):
    title = f"### {row.name}\n\n{row.package} {row.version}: {row.what}\n".replace("  ", " ")
    if row.why_not:
        return f"{title}\n*Not driven*: {row.why_not}\n"
    found = row.expected()
    parts = [title, f"*Guess*: {row.guess}\n"]
    if found is None:
        parts.append("*Found*: not run yet.\n")
    else:
        parts += _found(found)
    if row.unidentified:
        parts.append(f"*Not identified*: {row.unidentified}\n")
    parts.append(f"*To know*: {row.know}\n")
    parts.append(f"*Source*: {row.source}\n")
    parts.append(f"*Read by hand*: {row.reading}\n")
    return "\n".join(parts)


def _found(found):
    counts = found["verify"]["counts"]
    said = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    parts = [f"*Order*: {found['verify']['conclusion']} ({said}). {_declared(found)}\n"]
    if found.get("packages"):
        parts.append("*Debian*: " + ", ".join(f"{name} {version}" for name, version in found["packages"].items()) + "\n")
    held = found["held_out"]
    if found["rule"]:
        parts.append("```text\n" + "\n".join(found["rule"]) + "\n```\n")
        where = f"Holds on {held['agree']} of {held['rays']} rays that were held out, of {held['kinds']} kinds"
        if found["ladder"] and found["ladder"]["compared"]:
            where += f", and in {found['ladder']['agree']} of {found['ladder']['compared']} channels of the ladder"
        digits = [f"{found['bits']} significant bits"] if found["bits"] else []
        digits += [f"{found['decimals']} decimals"] if found["decimals"] else []
        parts.append(where + "." + "".join(f" Answers have {one}." for one in digits) + "\n")
    for one in found["deviations"]:
        parts.append(f"- `{one['name']}`: {one['does']}")
    if found["deviations"]:
        parts.append("")
    for reason in [] if found["rule"] else found["not_identified"]:
        parts.append(f"- not identified: {reason}")
    if not found["rule"] and found["not_identified"]:
        parts.append("")
    if batch := found.get("batch"):
        said = f"`{batch['name']}`: {batch['does']}" if batch["name"] else "each has the answer that it has alone"
        parts.append(f"*{batch['rays']} rays in one request*: {said}.\n")
    if "gradients" in found:
        parts.append(f"*Gradients*: {_gradients(found['gradients'])}\n")
    return parts


def _declared(found):
    declares = found["declares"]
    guess = f"`{declares['method']}`" if declares["method"] else f"order {declares['order']}"
    if declares["method"] is None and declares["order"] is None:
        guess = "no order"
    return f"Declared: {guess}, {declares['format']}."


def _gradients(gradients):
    counts = ", ".join(f"{count} {name}" for name, count in gradients["counts"].items() if count)
    own = gradients["own_values"]
    text = f"{gradients['conclusion']} ({counts}); {own['agree']} of {own['compared']} derivatives are those of the values"
    if gradients["deviations"]:
        text += "; deviations: " + ", ".join(f"`{name}`" for name in gradients["deviations"])
    return text + "."


def _orders(found):
    counts = found["verify"]["counts"]
    total = sum(counts.values())
    return f"{found['verify']['conclusion']}: {counts['confirmed']} of {total}, {counts['contradicted']} contradicted"


def _deviations(found):
    names = ", ".join(f"`{one['name']}`" for one in found["deviations"])
    return names or ("–" if found["rule"] else "*not identified*")


def _cell(text):
    return text.replace("|", "\\|")


def _anchor(row):
    return row.name.lower().replace(".", "")
