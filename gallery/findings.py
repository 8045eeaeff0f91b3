"""What was found of a package, in the form in which it is kept, and in what two of them differ."""

import math
import re

# Formulas hold numbers that were bisected or fitted: they agree when they are that close.
CLOSE = 0.01
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.])")


def found(packages, verified, identified, gradient):
    """The document that is kept: nothing in it changes from run to run."""
    kernel = verified["kernel"]
    document = {
        "declares": {key: kernel.get(key) for key in ["form", "method", "order", "format"]},
        "verify": {
            "conclusion": verified["conclusion"],
            "counts": verified["counts"],
            "as_declared": verified.get("as_declared"),
            "orders": orders(verified["lines"]),
        },
    }
    if packages:
        document["packages"] = packages
    if batch := verified.get("batch"):
        document["batch"] = {key: batch.get(key) for key in ["rays", "differ", "name", "does"]}
    document |= rule(identified or {})
    if gradient is not None:
        document["gradients"] = {key: gradient.get(key) for key in ["conclusion", "counts", "orders"]}
        own = gradient.get("own_values") or {}
        deviations = [one.get("name") for one in own.get("deviations", [])]
        document["gradients"]["own_values"] = {key: own.get(key) for key in ["compared", "agree"]}
        document["gradients"]["deviations"] = deviations
    return rounded(document)


def orders(lines):
    """How many channels were confirmed with which order, to a tenth, or contradicted with which verdict."""
    seen = {}
    for line in lines:
        if line["standing"] not in ("confirmed", "contradicted"):
            continue
        order = "" if line.get("order") is None else f" {round(line['order'], 1) + 0.0:g}"
        quantity = "" if line["quantity"] == "radiance" else f"{line['quantity']}: "
        name = f"{quantity}{line['standing']}, {line['verdict']}{order}"
        seen[name] = seen.get(name, 0) + 1
    return dict(sorted(seen.items()))


def rule(identified):
    """The formula, its deviations, and what is not identified."""
    named = identified.get("rule")
    validated = identified.get("validated", [])
    return {
        "rule": named["text"].split("\n") if named else None,
        "formula": named.get("formula") if named else None,
        "held_out": {
            "kinds": len(validated),
            "rays": sum(one["asked"] for one in validated),
            "agree": sum(one["agree"] for one in validated),
        },
        "ladder": identified.get("channels"),
        "bits": (identified.get("precision") or {}).get("bits"),
        "decimals": (identified.get("precision") or {}).get("decimals"),
        "accumulation": identified.get("accumulation"),
        "deviations": [
            {"name": one["name"], "value": one["value"], "does": one["does"]} for one in identified.get("deviations", [])
        ],
        "not_identified": [one["reason"] for one in identified.get("not_identified", [])],
    }


def rounded(value, digits=3):
    """Numbers to three digits; those of the formula, which is compared with other kernels', to six."""
    if isinstance(value, dict):
        return {key: rounded(item, 6 if key == "formula" else digits) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item, digits) for item in value]
    return float(f"{value:.{digits}g}") if isinstance(value, float) else value


def differences(expected, seen, path=""):
    """Where they differ, a text each."""
    if isinstance(expected, dict) and isinstance(seen, dict):
        keys = [*expected, *(key for key in seen if key not in expected)]
        below = path + "." if path else ""
        return [text for key in keys for text in differences(expected.get(key), seen.get(key), below + key)]
    if isinstance(expected, list) and isinstance(seen, list) and len(expected) == len(seen):
        pairs = enumerate(zip(expected, seen))
        return [text for i, (one, other) in pairs for text in differences(one, other, f"{path}[{i}]")]
    return [] if same(expected, seen) else [f"{path} was {short(expected)}, is {short(seen)}"]


def same(one, other):
    if isinstance(one, float) and isinstance(other, (int, float)) or isinstance(other, float) and isinstance(one, int):
        return math.isclose(one, other, rel_tol=CLOSE)
    if isinstance(one, str) and isinstance(other, str):
        numbers = zip(NUMBER.findall(one), NUMBER.findall(other))
        return NUMBER.sub("#", one) == NUMBER.sub("#", other) and all(
            math.isclose(float(a), float(b), rel_tol=CLOSE) for a, b in numbers
        )
    return one == other


def short(value):
    text = "nothing" if value is None else str(value)
    return text if len(text) <= 80 else text[:77] + "…"


def line(document):
    """One line of it."""
    deviations = ", ".join(one["name"] for one in document["deviations"]) or "none"
    named = f"deviations: {deviations}" if document["rule"] else "rule not identified"
    gradients = f"; gradients {document['gradients']['conclusion']}" if "gradients" in document else ""
    return f"{document['verify']['conclusion']}; {named}{gradients}"
