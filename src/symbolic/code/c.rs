//! C99.

use super::callee::Callee;
use super::layout::{self, Body, Choice, Layout};
use super::names::listed;
use crate::symbolic::Function;

/// C99 with binary64 as `double`.
pub(super) struct C;

/// Keywords up to C23, macros, and what the standard library defines; of `math.h` without the forms for
/// float and long double.
const WORDS: &str = "
    alignas alignof asm auto bool break case char const constexpr continue default do double else enum
    extern false float for goto if inline int long nullptr register restrict return short signed sizeof
    static static_assert struct switch thread_local true typedef typeof typeof_unqual union unsigned void
    volatile while
    NULL NAN INFINITY DOMAIN SING OVERFLOW UNDERFLOW TLOSS PLOSS HUGE MAXFLOAT X_TLOSS signgam
    math_errhandling float_t double_t linux unix i386 main lesser greater
    abort abs alloca atexit atof atoi atol bcmp bcopy bzero calloc cimag conj creal cproj carg div exit
    fclose feof ferror fopen fprintf fputc fputs fread free fscanf fwrite getc getchar gets gettext index
    isalnum isalpha isblank iscntrl isdigit isgraph islower isprint ispunct isspace isupper isxdigit labs
    link llabs malloc memchr memcmp memcpy memmove memset open printf putc putchar puts qsort raise rand
    read realloc remove rename rindex scanf signal snprintf sprintf srand sscanf stpcpy strcat strchr
    strcmp strcpy strcspn strdup strlen strncat strncmp strncpy strpbrk strrchr strspn strstr strtod strtol
    system time toascii tolower toupper write vprintf
    imaxabs execl execv fork putenv setenv sleep stdin stdout stderr errno ffs mempcpy
";

/// Functions of `math.h`; each has forms that end in f and l, too.
const MATH: &str = "
    acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem erf erfc exp exp10 exp2 expm1
    fabs fdim finite floor fma fmax fmin fmod fpclassify frexp gamma hypot ilogb isfinite isgreater
    isgreaterequal isinf isless islessequal islessgreater isnan isnormal isunordered j0 j1 jn ldexp lgamma
    llrint llround log log10 log1p log2 logb lrint lround modf nan nearbyint nextafter nexttoward pow pow10
    remainder remquo rint round scalb scalbln scalbn signbit significand sin sincos sinh sqrt tan tanh
    tgamma trunc y0 y1 yn cabs cacos cacosh casin casinh catan catanh ccos ccosh cexp clog cpow csin csinh
    csqrt ctan ctanh
    roundeven fmaximum fminimum fromfp nextup nextdown llogb canonicalize
";

const PROLOGUE: &str = "
#include <math.h>

// Every operation is rounded by itself: multiplications and additions must not be fused. For a compiler
// that knows neither line, add -ffp-contract=off; do not add -ffast-math.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize(\"fp-contract=off\")
#else
#pragma STDC FP_CONTRACT OFF
#endif
";

const LESSER: &str = "\
// The lesser of the two; NaN where one of them is.
static double lesser(double a, double b) {
    return b < a ? b : a <= b ? a : NAN;
}
";

const GREATER: &str = "\
// The greater of the two; NaN where one of them is.
static double greater(double a, double b) {
    return b > a ? b : a >= b ? a : NAN;
}
";

impl Layout for C {
    fn reserved(&self, name: &str) -> bool {
        let of_the_compiler = name
            .strip_prefix('_')
            .is_some_and(|rest| rest.starts_with(|c: char| c == '_' || c.is_ascii_uppercase()));
        // Compilers have names like __LINE__, but none with three underscores at the end.
        let of_the_compiler = of_the_compiler && !name.ends_with("___");
        let of_a_header = ["M_", "FP_", "HUGE_VAL", "MATH_"]
            .iter()
            .any(|prefix| name.starts_with(prefix) && !name.ends_with('_'));
        let double = name.strip_suffix(['f', 'l']).unwrap_or(name);
        of_the_compiler
            || of_a_header
            || listed(WORDS, name)
            || listed(MATH, name)
            || listed(MATH, double)
    }

    fn pi(&self) -> &'static str {
        "3.141592653589793"
    }

    fn infinity(&self) -> &'static str {
        "INFINITY"
    }

    fn nan(&self) -> &'static str {
        "NAN"
    }

    fn callee(&self, callee: Callee) -> &'static str {
        match callee {
            Callee::Function(Function::Ln) => "log",
            Callee::Function(Function::Abs) => "fabs",
            Callee::Function(function) => function.name(),
            Callee::Sqrt => "sqrt",
            Callee::ExpM1 => "expm1",
            Callee::Ln1p => "log1p",
            Callee::Min => "lesser",
            Callee::Max => "greater",
            Callee::Divide => "",
        }
    }

    fn helper(&self, callee: Callee) -> Option<&'static str> {
        match callee {
            Callee::Min => Some(LESSER),
            Callee::Max => Some(GREATER),
            _ => None,
        }
    }

    fn choice(&self, choice: &Choice<'_>) -> String {
        let (condition, opposite) = choice.conditions();
        let (then, otherwise) = (choice.then, choice.otherwise);
        format!("{condition} ? {then} : {opposite} ? {otherwise} : NAN")
    }

    fn comment(&self) -> &'static str {
        "//"
    }

    fn prologue(&self, _: &[Callee], _: &str) -> String {
        PROLOGUE.into()
    }

    fn gap(&self) -> &'static str {
        "\n"
    }

    fn constant(&self, name: &str, value: &str) -> String {
        format!("const double {name} = {value};\n")
    }

    fn function(&self, name: &str, doc: &[String], body: &Body) -> String {
        let parameters: Vec<String> = body
            .parameters
            .iter()
            .map(|parameter| format!("double {parameter}"))
            .collect();
        let parameters = if parameters.is_empty() {
            "void".into()
        } else {
            parameters.join(", ")
        };
        let mut text = layout::comment("//", doc);
        text.extend(["double ", name, "(", &parameters, ") {\n"]);
        for unused in &body.unused {
            text.extend(["    (void)", unused, ";\n"]);
        }
        for (step, value) in &body.steps {
            text.extend(["    const double ", step, " = ", value, ";\n"]);
        }
        text + &format!("    return {};\n}}\n", body.value)
    }
}
