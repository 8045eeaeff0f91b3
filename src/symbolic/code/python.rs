//! Python 3.

use super::callee::Callee;
use super::layout::{Body, Choice, Layout};
use super::names::listed;
use crate::symbolic::Function;

/// Python 3 with its module `math`, which raises exceptions where IEEE 754 has infinities and NaN.
pub(super) struct Python;

/// Keywords, and the names that generated code uses.
const WORDS: &str = "
    False None True and as assert async await break class continue def del elif else except finally for
    from global if import in is lambda nonlocal not or pass raise return try while with yield
    __debug__ abs float math OverflowError ZeroDivisionError
    _div _sqrt _exp _expm1 _log _log1p _sin _cos _tan _sinh _cosh _min _max
";

const DIV: &str = "\
def _div(a, b):
    \"\"\"a/b, infinite or NaN where b is 0.\"\"\"
    try:
        return a / b
    except ZeroDivisionError:
        if a == 0.0 or math.isnan(a):
            return math.nan
        return math.copysign(math.inf, a) * math.copysign(1.0, b)
";

const SQRT: &str = "\
def _sqrt(x):
    \"\"\"The square root, NaN for x < 0.\"\"\"
    return math.sqrt(x) if x >= 0.0 else math.nan
";

const EXP: &str = "\
def _exp(x):
    \"\"\"e^x, infinite where it overflows.\"\"\"
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf
";

const EXPM1: &str = "\
def _expm1(x):
    \"\"\"e^x - 1, infinite where it overflows.\"\"\"
    try:
        return math.expm1(x)
    except OverflowError:
        return math.inf
";

const LOG: &str = "\
def _log(x):
    \"\"\"The natural logarithm, -inf at 0 and NaN for x < 0.\"\"\"
    if x > 0.0:
        return math.log(x)
    return -math.inf if x == 0.0 else math.nan
";

const LOG1P: &str = "\
def _log1p(x):
    \"\"\"The natural logarithm of 1 + x, -inf at -1 and NaN for x < -1.\"\"\"
    if x > -1.0:
        return math.log1p(x)
    return -math.inf if x == -1.0 else math.nan
";

const SIN: &str = "\
def _sin(x):
    \"\"\"The sine, NaN where x is infinite.\"\"\"
    return math.sin(x) if math.isfinite(x) else math.nan
";

const COS: &str = "\
def _cos(x):
    \"\"\"The cosine, NaN where x is infinite.\"\"\"
    return math.cos(x) if math.isfinite(x) else math.nan
";

const TAN: &str = "\
def _tan(x):
    \"\"\"The tangent, NaN where x is infinite.\"\"\"
    return math.tan(x) if math.isfinite(x) else math.nan
";

const SINH: &str = "\
def _sinh(x):
    \"\"\"The hyperbolic sine, infinite where it overflows.\"\"\"
    try:
        return math.sinh(x)
    except OverflowError:
        return math.copysign(math.inf, x)
";

const COSH: &str = "\
def _cosh(x):
    \"\"\"The hyperbolic cosine, infinite where it overflows.\"\"\"
    try:
        return math.cosh(x)
    except OverflowError:
        return math.inf
";

const MIN: &str = "\
def _min(a, b):
    \"\"\"The lesser of the two; NaN where one of them is.\"\"\"
    return b if b < a else a if a <= b else math.nan
";

const MAX: &str = "\
def _max(a, b):
    \"\"\"The greater of the two; NaN where one of them is.\"\"\"
    return b if b > a else a if a >= b else math.nan
";

impl Layout for Python {
    fn reserved(&self, name: &str) -> bool {
        listed(WORDS, name)
    }

    fn pi(&self) -> &'static str {
        "math.pi"
    }

    fn infinity(&self) -> &'static str {
        "math.inf"
    }

    fn nan(&self) -> &'static str {
        "math.nan"
    }

    fn callee(&self, callee: Callee) -> &'static str {
        match callee {
            Callee::Function(Function::Exp) => "_exp",
            Callee::Function(Function::Ln) => "_log",
            Callee::Function(Function::Sin) => "_sin",
            Callee::Function(Function::Cos) => "_cos",
            Callee::Function(Function::Tan) => "_tan",
            Callee::Function(Function::Sinh) => "_sinh",
            Callee::Function(Function::Cosh) => "_cosh",
            Callee::Function(Function::Tanh) => "math.tanh",
            Callee::Function(Function::Atan) => "math.atan",
            Callee::Function(Function::Erf) => "math.erf",
            Callee::Function(Function::Abs) => "abs",
            Callee::Sqrt => "_sqrt",
            Callee::ExpM1 => "_expm1",
            Callee::Ln1p => "_log1p",
            Callee::Min => "_min",
            Callee::Max => "_max",
            Callee::Divide => "_div",
        }
    }

    fn helper(&self, callee: Callee) -> Option<&'static str> {
        match callee {
            Callee::Function(Function::Exp) => Some(EXP),
            Callee::Function(Function::Ln) => Some(LOG),
            Callee::Function(Function::Sin) => Some(SIN),
            Callee::Function(Function::Cos) => Some(COS),
            Callee::Function(Function::Tan) => Some(TAN),
            Callee::Function(Function::Sinh) => Some(SINH),
            Callee::Function(Function::Cosh) => Some(COSH),
            Callee::Function(Function::Tanh | Function::Atan | Function::Erf | Function::Abs) => {
                None
            }
            Callee::Sqrt => Some(SQRT),
            Callee::ExpM1 => Some(EXPM1),
            Callee::Ln1p => Some(LOG1P),
            Callee::Min => Some(MIN),
            Callee::Max => Some(MAX),
            Callee::Divide => Some(DIV),
        }
    }

    fn division_raises(&self) -> bool {
        true
    }

    fn choice(&self, choice: &Choice<'_>) -> String {
        let (condition, opposite) = choice.conditions();
        let (then, otherwise) = (choice.then, choice.otherwise);
        format!("{then} if {condition} else {otherwise} if {opposite} else math.nan")
    }

    fn comment(&self) -> &'static str {
        "#"
    }

    fn prologue(&self, _: &[Callee], code: &str) -> String {
        if code.contains("math.") {
            "\nimport math\n".into()
        } else {
            String::new()
        }
    }

    fn gap(&self) -> &'static str {
        "\n\n"
    }

    fn constant(&self, name: &str, value: &str) -> String {
        format!("{name} = {value}\n")
    }

    fn function(&self, name: &str, doc: &[String], body: &Body) -> String {
        let parameters: Vec<String> = body
            .parameters
            .iter()
            .map(|parameter| format!("{parameter}: float"))
            .collect();
        let mut text = format!("def {name}({}) -> float:\n", parameters.join(", "));
        if !doc.is_empty() {
            let doc = doc.join("\n").replace('\\', r"\\").replace('"', "\\\"");
            let doc = doc.replace('\n', "\n    ").replace("\n    \n", "\n\n");
            let end = if doc.contains('\n') { "\n    " } else { "" };
            text.extend(["    \"\"\"", &doc, end, "\"\"\"\n"]);
        }
        for (step, value) in &body.steps {
            text.extend(["    ", step, " = ", value, "\n"]);
        }
        text + &format!("    return {}\n", body.value)
    }
}
