"""What the program writes as JSON; made from its schemas by python/generate.py."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ._record import Record


@dataclass(eq=False, repr=False)
class Counts(Record):
    """Counts."""

    blind: int
    confirmed: int
    contradicted: int
    failed: int
    inconclusive: int
    unresolved: int

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Counts:
        """From JSON."""
        return cls(
            blind=data["blind"],
            confirmed=data["confirmed"],
            contradicted=data["contradicted"],
            failed=data["failed"],
            inconclusive=data["inconclusive"],
            unresolved=data["unresolved"],
        )


@dataclass(eq=False, repr=False)
class Finding(Record):
    """Finding."""

    channels: list[str]
    words: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Finding:
        """From JSON."""
        return cls(
            channels=data["channels"],
            words=data["words"],
        )


@dataclass(eq=False, repr=False)
class UlpBound(Record):
    """A function of x is off by at most a + b |x| units in the last place of its result."""

    a: float
    b: float

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> UlpBound:
        """From JSON."""
        return cls(
            a=data["a"],
            b=data["b"],
        )


@dataclass(eq=False, repr=False)
class Kernel(Record):
    """What is declared beside the format, where anything is."""

    answers: list[str]
    background: bool
    far_wall: bool
    form: str
    format: str
    method: str | None
    multiple_of: int
    name: str
    order: float | None
    quantum: Any
    sampling: str | None
    step_divides: bool
    stochastic: bool
    batch: int | None = None
    channels: int | None = None
    emission: str | None = None
    exp_ulp: UlpBound | None = None
    expected_depth: str | None = None
    expm1_ulp: UlpBound | None = None
    noise: float | None = None
    output: str | None = None
    pow_ulp: UlpBound | None = None
    source: str | None = None
    subnormals: str | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Kernel:
        """From JSON."""
        return cls(
            answers=data["answers"],
            background=data["background"],
            far_wall=data["far_wall"],
            form=data["form"],
            format=data["format"],
            method=data["method"],
            multiple_of=data["multiple_of"],
            name=data["name"],
            order=data["order"],
            quantum=data["quantum"],
            sampling=data["sampling"],
            step_divides=data["step_divides"],
            stochastic=data["stochastic"],
            batch=data.get("batch"),
            channels=data.get("channels"),
            emission=data.get("emission"),
            exp_ulp=None if data.get("exp_ulp") is None else UlpBound.read(data["exp_ulp"]),
            expected_depth=data.get("expected_depth"),
            expm1_ulp=None if data.get("expm1_ulp") is None else UlpBound.read(data["expm1_ulp"]),
            noise=data.get("noise"),
            output=data.get("output"),
            pow_ulp=None if data.get("pow_ulp") is None else UlpBound.read(data["pow_ulp"]),
            source=data.get("source"),
            subnormals=data.get("subnormals"),
        )


@dataclass(eq=False, repr=False)
class Failure(Record):
    """Failure."""

    error: str
    segments: int

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Failure:
        """From JSON."""
        return cls(
            error=data["error"],
            segments=data["segments"],
        )


@dataclass(eq=False, repr=False)
class Beyond(Record):
    """From where on levels do not show the order."""

    by: str
    """What takes over."""
    n: int
    """Segments of the finest level that still shows discretization."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Beyond:
        """From JSON."""
        return cls(
            by=data["by"],
            n=data["n"],
        )


@dataclass(eq=False, repr=False)
class FloorCut(Record):
    """Where the roundoff floor ended the ladder."""

    floor: float | str
    """The floor there: the largest of this level's and of all coarser ones."""
    level: int
    """Index of the first level dropped; everything finer is dropped too."""
    step: float
    """Its step."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> FloorCut:
        """From JSON."""
        return cls(
            floor=data["floor"],
            level=data["level"],
            step=data["step"],
        )


@dataclass(eq=False, repr=False)
class Pair(Record):
    """Two neighbouring levels with finite, nonzero errors."""

    above_floor: bool
    """Both levels stand above the floor."""
    coarse: int
    """Index of the coarser level; the finer one is the next."""
    in_window: bool
    """Both levels lie in the window."""
    order: float
    """ln|eᵢ/eᵢ₊₁| / ln(dᵢ/dᵢ₊₁)."""
    sign_change: bool
    """The error changes sign between the two."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Pair:
        """From JSON."""
        return cls(
            above_floor=data["above_floor"],
            coarse=data["coarse"],
            in_window=data["in_window"],
            order=data["order"],
            sign_change=data["sign_change"],
        )


@dataclass(eq=False, repr=False)
class Window(Record):
    """The levels an order was fitted in."""

    coarsest_n: int | None
    """Number of segments of the coarsest level, where known."""
    coarsest_step: float
    """Step of the coarsest level."""
    finest_n: int | None
    """Number of segments of the finest level, where known."""
    finest_step: float
    """Step of the finest level."""
    first: int
    """Index of the coarsest level."""
    last: int
    """Index of the finest level."""
    tolerance: float
    """How closely the pairwise orders agree with the last: 0.02, 0.05, 0.1 or 0.25; of errors with standard errors,
    the largest distance."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Window:
        """From JSON."""
        return cls(
            coarsest_n=data["coarsest_n"],
            coarsest_step=data["coarsest_step"],
            finest_n=data["finest_n"],
            finest_step=data["finest_step"],
            first=data["first"],
            last=data["last"],
            tolerance=data["tolerance"],
        )


@dataclass(eq=False, repr=False)
class Fit(Record):
    """An order of accuracy with its interval, and what that says."""

    cut: FloorCut | None
    """Where the floor ended the ladder, if it did."""
    floor: float | str
    """Largest floor of all levels; 0 where none is known."""
    half_width: float | None
    """Half-width of the order's interval. Without a window it is a spread, not an interval: the largest distance of
    the last three usable pairwise orders from the last, and at least twice that of the last two; for one pair alone,
    |p|."""
    log2_constant: float | None
    """log₂ c in |e| = c·dᵖ."""
    notes: list[dict[str, Any]]
    """Remarks."""
    order: float | None
    """The order p: fitted in the window; without a window, the last pairwise order above the floor. `None` with fewer
    than two usable levels."""
    pairs: list[Pair]
    """Pairwise orders, coarse to fine."""
    verdict: str
    """What the errors say of the expectation."""
    window: Window | None
    """The levels the order was fitted in."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Fit:
        """From JSON."""
        return cls(
            cut=None if data["cut"] is None else FloorCut.read(data["cut"]),
            floor=data["floor"],
            half_width=data["half_width"],
            log2_constant=data["log2_constant"],
            notes=data["notes"],
            order=data["order"],
            pairs=[Pair.read(one) for one in data["pairs"]],
            verdict=data["verdict"],
            window=None if data["window"] is None else Window.read(data["window"]),
        )


@dataclass(eq=False, repr=False)
class ReportedError(Record):
    """Reported standard errors as a multiple of the scatter."""

    high: float | None
    """Upper end."""
    low: float | None
    """Lower end of its 99.99 % interval."""
    ratio: float | None
    """√(mean of reported²)/s, the geometric mean over the finest levels; NaN where one reported is negative or no
    number."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> ReportedError:
        """From JSON."""
        return cls(
            high=data["high"],
            low=data["low"],
            ratio=data["ratio"],
        )


@dataclass(eq=False, repr=False)
class Sample(Record):
    """One run at one level: its step, its signed error, and the roundoff floor there."""

    error: float | str
    """Signed error, approximation − exact, of any precision and magnitude."""
    floor: float | str
    """Magnitude below which the error is roundoff; 0 where none is known."""
    n: int | None
    """Number of segments, where the step divides the ray."""
    step: float
    """Step d > 0."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Sample:
        """From JSON."""
        return cls(
            error=data["error"],
            floor=data["floor"],
            n=data["n"],
            step=data["step"],
        )


@dataclass(eq=False, repr=False)
class OrderInterval(Record):
    """An order with its 99.9 % interval."""

    high: float | None
    """Upper end; ∞ (`null` in JSON) where the levels leave it open."""
    levels: int
    """Levels the fit rests on: so many of the finest that stand above the floor."""
    log2_constant: float
    """log₂ c in c·dᵖ."""
    low: float | None
    """Lower end; −∞ (`null` in JSON) where the levels leave it open."""
    order: float
    """The order p."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> OrderInterval:
        """From JSON."""
        return cls(
            high=data["high"],
            levels=data["levels"],
            log2_constant=data["log2_constant"],
            low=data["low"],
            order=data["order"],
        )


@dataclass(eq=False, repr=False)
class LevelMoments(Record):
    """Mean and standard deviation of one level."""

    above_floor: bool
    """The standard deviation stands above the floor, here and at all coarser levels."""
    biased: bool
    """The mean stands above the floor and is not 0 by chance: see `fit_replicas`."""
    deviation: float
    """Standard deviation of the errors (R − 1 in the denominator)."""
    mean: float
    """Mean error: the bias."""
    n: int | None
    """Number of segments, where known."""
    standard_error: float
    """Standard error of the mean."""
    step: float
    """Step."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> LevelMoments:
        """From JSON."""
        return cls(
            above_floor=data["above_floor"],
            biased=data["biased"],
            deviation=data["deviation"],
            mean=data["mean"],
            n=data["n"],
            standard_error=data["standard_error"],
            step=data["step"],
        )


@dataclass(eq=False, repr=False)
class StochasticFit(Record):
    """The orders of a stochastic method: of its scatter, and of its bias."""

    bias: OrderInterval | None
    """Order of the bias; `None` where no mean is significant, or no four fine levels keep to one."""
    bias_may_stay: bool
    """A mean is significant at one of the finest levels, and does not fall for all that is known."""
    deviation: OrderInterval | None
    """Order of the standard deviation; `None` where no four fine levels above the floor keep to one."""
    larger: str
    """The part that is larger at the finest level above the floor."""
    levels: list[LevelMoments]
    """What was fitted, coarse to fine."""
    replicas: int
    """Replicas a level."""
    verdict: str
    """What both orders say of the expectation."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> StochasticFit:
        """From JSON."""
        return cls(
            bias=None if data["bias"] is None else OrderInterval.read(data["bias"]),
            bias_may_stay=data["bias_may_stay"],
            deviation=None if data["deviation"] is None else OrderInterval.read(data["deviation"]),
            larger=data["larger"],
            levels=[LevelMoments.read(one) for one in data["levels"]],
            replicas=data["replicas"],
            verdict=data["verdict"],
        )


@dataclass(eq=False, repr=False)
class Unproved(Record):
    """A statement that a case rests on and that is not proved."""

    claim: str
    """The statement: "tau defined"."""
    reason: str
    """What became of it: "undecided near lambda = 11/7"."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Unproved:
        """From JSON."""
        return cls(
            claim=data["claim"],
            reason=data["reason"],
        )


@dataclass(eq=False, repr=False)
class Line(Record):
    """Line."""

    exact: float | str
    expected: str
    failures: list[Failure]
    half_width: float | None
    largest_error: float | None
    """The largest of all levels, as a part of the radiance."""
    name: str
    order: float | None
    quantity: str
    standing: str
    steady: bool
    verdict: str
    beyond: Beyond | None = None
    """From where on levels do not show an order of three or more."""
    fit: Fit | None = None
    remarks: list[str] | None = None
    reported_errors: ReportedError | None = None
    samples: list[Sample] | None = None
    stochastic: StochasticFit | None = None
    unproved: list[Unproved] | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Line:
        """From JSON."""
        return cls(
            exact=data["exact"],
            expected=data["expected"],
            failures=[Failure.read(one) for one in data["failures"]],
            half_width=data["half_width"],
            largest_error=data["largest_error"],
            name=data["name"],
            order=data["order"],
            quantity=data["quantity"],
            standing=data["standing"],
            steady=data["steady"],
            verdict=data["verdict"],
            beyond=None if data.get("beyond") is None else Beyond.read(data["beyond"]),
            fit=None if data.get("fit") is None else Fit.read(data["fit"]),
            remarks=data.get("remarks"),
            reported_errors=None if data.get("reported_errors") is None else ReportedError.read(data["reported_errors"]),
            samples=None if data.get("samples") is None else [Sample.read(one) for one in data["samples"]],
            stochastic=None if data.get("stochastic") is None else StochasticFit.read(data["stochastic"]),
            unproved=None if data.get("unproved") is None else [Unproved.read(one) for one in data["unproved"]],
        )


@dataclass(eq=False, repr=False)
class Answers(Record):
    """A quantity that is answered beside the first."""

    counts: Counts
    quantity: str
    shown: bool

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Answers:
        """From JSON."""
        return cls(
            counts=Counts.read(data["counts"]),
            quantity=data["quantity"],
            shown=data["shown"],
        )


@dataclass(eq=False, repr=False)
class Declared(Record):
    """In how many channels values are those of the declared method."""

    agree: int
    of: int

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Declared:
        """From JSON."""
        return cls(
            agree=data["agree"],
            of=data["of"],
        )


@dataclass(eq=False, repr=False)
class Apart(Record):
    """The first ray that differs."""

    alone: list[str] | None
    """The radiances; null where there is no answer."""
    ray: int
    segments: int
    step: float
    together: list[str] | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Apart:
        """From JSON."""
        return cls(
            alone=data["alone"],
            ray=data["ray"],
            segments=data["segments"],
            step=data["step"],
            together=data["together"],
        )


@dataclass(eq=False, repr=False)
class Batch(Record):
    """Many rays in one request."""

    accepted: bool
    differ: int
    """How many have another answer than alone."""
    rays: int
    segments: list[int]
    """Of the shortest and of the longest."""
    does: str | None = None
    first: Apart | None = None
    name: str | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Batch:
        """From JSON."""
        return cls(
            accepted=data["accepted"],
            differ=data["differ"],
            rays=data["rays"],
            segments=data["segments"],
            does=data.get("does"),
            first=None if data.get("first") is None else Apart.read(data["first"]),
            name=data.get("name"),
        )


@dataclass(eq=False, repr=False)
class Agreement(Record):
    """The rule against the values of the ladder."""

    agree: int
    compared: int
    differ: list[str]

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Agreement:
        """From JSON."""
        return cls(
            agree=data["agree"],
            compared=data["compared"],
            differ=data["differ"],
        )


@dataclass(eq=False, repr=False)
class Cost(Record):
    """What was asked."""

    longest: int
    rays: int
    rays_for_witness: int
    segments: int
    unanswered: int

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Cost:
        """From JSON."""
        return cls(
            longest=data["longest"],
            rays=data["rays"],
            rays_for_witness=data["rays_for_witness"],
            segments=data["segments"],
            unanswered=data["unanswered"],
        )


@dataclass(eq=False, repr=False)
class Deviation(Record):
    """Deviation."""

    bracket: list[float] | None
    does: str
    exact: bool
    """A count, or an answer as it came."""
    instead_of: str | None
    name: str
    probe: str
    validated: list[str]
    """Kinds of rays."""
    value: float | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Deviation:
        """From JSON."""
        return cls(
            bracket=data["bracket"],
            does=data["does"],
            exact=data["exact"],
            instead_of=data["instead_of"],
            name=data["name"],
            probe=data["probe"],
            validated=data["validated"],
            value=data["value"],
        )


@dataclass(eq=False, repr=False)
class NotIdentified(Record):
    """NotIdentified."""

    columns: list[str]
    reason: str
    rows: list[list[float]]

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> NotIdentified:
        """From JSON."""
        return cls(
            columns=data["columns"],
            reason=data["reason"],
            rows=data["rows"],
        )


@dataclass(eq=False, repr=False)
class OpacityShown(Record):
    """OpacityShown."""

    got: float | None
    task: Any
    text: str
    want: float | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> OpacityShown:
        """From JSON."""
        return cls(
            got=data["got"],
            task=data["task"],
            text=data["text"],
            want=data["want"],
        )


@dataclass(eq=False, repr=False)
class Opacity(Record):
    """Opacity."""

    agree: int
    answered: int
    largest_difference: float | None
    """Null where it is not finite."""
    witness: OpacityShown | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Opacity:
        """From JSON."""
        return cls(
            agree=data["agree"],
            answered=data["answered"],
            largest_difference=data["largest_difference"],
            witness=None if data.get("witness") is None else OpacityShown.read(data["witness"]),
        )


@dataclass(eq=False, repr=False)
class Part(Record):
    """Part."""

    part: str
    value: float | None
    words: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Part:
        """From JSON."""
        return cls(
            part=data["part"],
            value=data["value"],
            words=data["words"],
        )


@dataclass(eq=False, repr=False)
class Rule(Record):
    """Rule."""

    c: str
    formula: Any
    """Every parameter, as `Rule` has them."""
    latex: str
    parts: list[Part]
    python: str
    text: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Rule:
        """From JSON."""
        return cls(
            c=data["c"],
            formula=data["formula"],
            latex=data["latex"],
            parts=[Part.read(one) for one in data["parts"]],
            python=data["python"],
            text=data["text"],
        )


@dataclass(eq=False, repr=False)
class Validated(Record):
    """Validated."""

    agree: int
    asked: int
    digits: float | None
    rays: str
    unanswered: int

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Validated:
        """From JSON."""
        return cls(
            agree=data["agree"],
            asked=data["asked"],
            digits=data["digits"],
            rays=data["rays"],
            unanswered=data["unanswered"],
        )


@dataclass(eq=False, repr=False)
class Scattered(Record):
    """Scattered."""

    law: Any
    one_shift: bool
    """Whether all samples of a ray lie at the same part of their segments."""
    seeds: int
    standard_errors: float | None
    text: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Scattered:
        """From JSON."""
        return cls(
            law=data["law"],
            one_shift=data["one_shift"],
            seeds=data["seeds"],
            standard_errors=data["standard_errors"],
            text=data["text"],
        )


@dataclass(eq=False, repr=False)
class Witness(Record):
    """Witness."""

    channel: int
    got: float | None
    """Null where it is not finite."""
    task: Any
    """As it is asked, for `--replay`."""
    text: str
    tolerance: float | None
    want: float | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Witness:
        """From JSON."""
        return cls(
            channel=data["channel"],
            got=data["got"],
            task=data["task"],
            text=data["text"],
            tolerance=data["tolerance"],
            want=data["want"],
        )


@dataclass(eq=False, repr=False)
class Identified(Record):
    """What was found out of one kernel."""

    accepted: list[str]
    channels: Agreement
    cost: Cost
    deviations: list[Deviation]
    named: bool
    """Whether the rule holds in most channels too."""
    not_identified: list[NotIdentified]
    opacity: Opacity
    rule: Rule | None
    """Only where it is named."""
    transmittance_by_subtraction: bool
    """Transmittances are 1 less the opacity so far."""
    validated: list[Validated]
    verdict: str
    accumulation: Any = None
    """In what order contributions are added."""
    exponential: Any = None
    """By how many units of 2^(−24) exponentials are off."""
    method: str | None = None
    """The method that states no rule and has all the answers."""
    precision: Any = None
    """The digits that all answers held out make do with."""
    scattered: Scattered | None = None
    """Of a kernel that draws random numbers."""
    transmittance: Any = None
    """How transmittances are kept."""
    volume: str | None = None
    """What is read of a volume."""
    witness: Witness | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Identified:
        """From JSON."""
        return cls(
            accepted=data["accepted"],
            channels=Agreement.read(data["channels"]),
            cost=Cost.read(data["cost"]),
            deviations=[Deviation.read(one) for one in data["deviations"]],
            named=data["named"],
            not_identified=[NotIdentified.read(one) for one in data["not_identified"]],
            opacity=Opacity.read(data["opacity"]),
            rule=None if data["rule"] is None else Rule.read(data["rule"]),
            transmittance_by_subtraction=data["transmittance_by_subtraction"],
            validated=[Validated.read(one) for one in data["validated"]],
            verdict=data["verdict"],
            accumulation=data.get("accumulation"),
            exponential=data.get("exponential"),
            method=data.get("method"),
            precision=data.get("precision"),
            scattered=None if data.get("scattered") is None else Scattered.read(data["scattered"]),
            transmittance=data.get("transmittance"),
            volume=data.get("volume"),
            witness=None if data.get("witness") is None else Witness.read(data["witness"]),
        )


@dataclass(eq=False, repr=False)
class Verification(Record):
    """Verification."""

    axis: str
    conclusion: str
    counts: Counts
    findings: list[Finding]
    kernel: Kernel
    ladder: list[int]
    lines: list[Line]
    steps: str
    volver: str
    answers: list[Answers] | None = None
    """Beside the first that it answers."""
    as_declared: Declared | None = None
    batch: Batch | None = None
    different_seeds: int | None = None
    identification: Identified | None = None
    left_out: list[str] | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Verification:
        """From JSON."""
        return cls(
            axis=data["axis"],
            conclusion=data["conclusion"],
            counts=Counts.read(data["counts"]),
            findings=[Finding.read(one) for one in data["findings"]],
            kernel=Kernel.read(data["kernel"]),
            ladder=data["ladder"],
            lines=[Line.read(one) for one in data["lines"]],
            steps=data["steps"],
            volver=data["volver"],
            answers=None if data.get("answers") is None else [Answers.read(one) for one in data["answers"]],
            as_declared=None if data.get("as_declared") is None else Declared.read(data["as_declared"]),
            batch=None if data.get("batch") is None else Batch.read(data["batch"]),
            different_seeds=data.get("different_seeds"),
            identification=None if data.get("identification") is None else Identified.read(data["identification"]),
            left_out=data.get("left_out"),
        )


@dataclass(eq=False, repr=False)
class Differing(Record):
    """Differing."""

    one: str | None
    other: str | None
    part: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Differing:
        """From JSON."""
        return cls(
            one=data["one"],
            other=data["other"],
            part=data["part"],
        )


@dataclass(eq=False, repr=False)
class Compared(Record):
    """Compared."""

    agree: bool
    differ: int
    differences: list[Differing]
    kernel: str
    rays: int
    same_bits: int
    unanswered: int
    witness: Witness | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Compared:
        """From JSON."""
        return cls(
            agree=data["agree"],
            differ=data["differ"],
            differences=[Differing.read(one) for one in data["differences"]],
            kernel=data["kernel"],
            rays=data["rays"],
            same_bits=data["same_bits"],
            unanswered=data["unanswered"],
            witness=None if data["witness"] is None else Witness.read(data["witness"]),
        )


@dataclass(eq=False, repr=False)
class Identification(Record):
    """What was found out of one kernel."""

    cost: Cost
    deviations: list[Deviation]
    kernel: str
    not_identified: list[NotIdentified]
    opacity: Opacity
    rule: Rule | None
    """Only where it is named."""
    transmittance_by_subtraction: bool
    """Transmittances are 1 less the opacity so far."""
    validated: list[Validated]
    verdict: str
    volver: str
    accumulation: Any = None
    """In what order contributions are added."""
    against: Compared | None = None
    exponential: Any = None
    """By how many units of 2^(−24) exponentials are off."""
    method: str | None = None
    """The method that states no rule and has all the answers."""
    precision: Any = None
    """The digits that all answers held out make do with."""
    scattered: Scattered | None = None
    """Of a kernel that draws random numbers."""
    transmittance: Any = None
    """How transmittances are kept."""
    volume: str | None = None
    """What is read of a volume."""
    witness: Witness | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Identification:
        """From JSON."""
        return cls(
            cost=Cost.read(data["cost"]),
            deviations=[Deviation.read(one) for one in data["deviations"]],
            kernel=data["kernel"],
            not_identified=[NotIdentified.read(one) for one in data["not_identified"]],
            opacity=Opacity.read(data["opacity"]),
            rule=None if data["rule"] is None else Rule.read(data["rule"]),
            transmittance_by_subtraction=data["transmittance_by_subtraction"],
            validated=[Validated.read(one) for one in data["validated"]],
            verdict=data["verdict"],
            volver=data["volver"],
            accumulation=data.get("accumulation"),
            against=None if data.get("against") is None else Compared.read(data["against"]),
            exponential=data.get("exponential"),
            method=data.get("method"),
            precision=data.get("precision"),
            scattered=None if data.get("scattered") is None else Scattered.read(data["scattered"]),
            transmittance=data.get("transmittance"),
            volume=data.get("volume"),
            witness=None if data.get("witness") is None else Witness.read(data["witness"]),
        )


@dataclass(eq=False, repr=False)
class Fitted(Record):
    """The document: the fields of the library's `Fit` and what they rest on."""

    at_least: float | None
    """The order that has to be reached, or null."""
    cut: FloorCut | None
    """Where the floor ended the ladder, if it did."""
    expected: Any
    """The order expected, the word `exact`, or null."""
    floor: float | str
    """Largest floor of all levels; 0 where none is known."""
    floor_source: str
    half_width: float | None
    """Half-width of the order's interval. Without a window it is a spread, not an interval: the largest distance of
    the last three usable pairwise orders from the last, and at least twice that of the last two; for one pair alone,
    |p|."""
    log2_constant: float | None
    """log₂ c in |e| = c·dᵖ."""
    notes: list[dict[str, Any]]
    """Remarks."""
    order: float | None
    """The order p: fitted in the window; without a window, the last pairwise order above the floor. `None` with fewer
    than two usable levels."""
    pairs: list[Pair]
    """Pairwise orders, coarse to fine."""
    passes: bool | None
    """Whether the checks pass; null where none was asked for."""
    samples: list[Sample]
    source: str
    verdict: str
    """What the errors say of the expectation."""
    window: Window | None
    """The levels the order was fitted in."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Fitted:
        """From JSON."""
        return cls(
            at_least=data["at_least"],
            cut=None if data["cut"] is None else FloorCut.read(data["cut"]),
            expected=data["expected"],
            floor=data["floor"],
            floor_source=data["floor_source"],
            half_width=data["half_width"],
            log2_constant=data["log2_constant"],
            notes=data["notes"],
            order=data["order"],
            pairs=[Pair.read(one) for one in data["pairs"]],
            passes=data["passes"],
            samples=[Sample.read(one) for one in data["samples"]],
            source=data["source"],
            verdict=data["verdict"],
            window=None if data["window"] is None else Window.read(data["window"]),
        )


@dataclass(eq=False, repr=False)
class Taylor(Record):
    """Taylor."""

    first: float | None
    fit: Fit
    passes: bool
    remainder: str
    roundoff: int | None
    samples: list[Sample]
    second: float | None
    slope: float | None
    wrong_by: float | None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Taylor:
        """From JSON."""
        return cls(
            first=data["first"],
            fit=Fit.read(data["fit"]),
            passes=data["passes"],
            remainder=data["remainder"],
            roundoff=data["roundoff"],
            samples=[Sample.read(one) for one in data["samples"]],
            second=data["second"],
            slope=data["slope"],
            wrong_by=data["wrong_by"],
        )


@dataclass(eq=False, repr=False)
class Reference(Record):
    """Reference."""

    asked: int
    channel: str | None
    difference: Any
    digits: int | None
    error: float | str
    evaluations: int
    name: str
    not_proved: str | None
    panels: int
    points: int
    proved: bool
    radiance: str
    source: str
    transcendental_calls: int
    unproved: list[Unproved]
    """What the value rests on without a proof."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Reference:
        """From JSON."""
        return cls(
            asked=data["asked"],
            channel=data["channel"],
            difference=data["difference"],
            digits=data["digits"],
            error=data["error"],
            evaluations=data["evaluations"],
            name=data["name"],
            not_proved=data["not_proved"],
            panels=data["panels"],
            points=data["points"],
            proved=data["proved"],
            radiance=data["radiance"],
            source=data["source"],
            transcendental_calls=data["transcendental_calls"],
            unproved=[Unproved.read(one) for one in data["unproved"]],
        )


@dataclass(eq=False, repr=False)
class References(Record):
    """References."""

    references: list[Reference]
    volver: str

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> References:
        """From JSON."""
        return cls(
            references=[Reference.read(one) for one in data["references"]],
            volver=data["volver"],
        )


@dataclass(eq=False, repr=False)
class Best(Record):
    """Best."""

    error: float | str
    n: float

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Best:
        """From JSON."""
        return cls(
            error=data["error"],
            n=data["n"],
        )


@dataclass(eq=False, repr=False)
class StudyRow(Record):
    """What needs errors that are split."""

    bits: int
    case: str
    contradicts_theory: bool
    expected: Any
    format: str
    method: str
    radiance: float | str
    states: dict[str, int]
    """Levels by what became of them."""
    total: Fit
    best: Best | None = None
    bits_needed: list[Any] | None = None
    crossing: float | None = None
    discretization: Fit | None = None
    laws: Any = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> StudyRow:
        """From JSON."""
        return cls(
            bits=data["bits"],
            case=data["case"],
            contradicts_theory=data["contradicts_theory"],
            expected=data["expected"],
            format=data["format"],
            method=data["method"],
            radiance=data["radiance"],
            states=data["states"],
            total=Fit.read(data["total"]),
            best=None if data.get("best") is None else Best.read(data["best"]),
            bits_needed=data.get("bits_needed"),
            crossing=data.get("crossing"),
            discretization=None if data.get("discretization") is None else Fit.read(data["discretization"]),
            laws=data.get("laws"),
        )


@dataclass(eq=False, repr=False)
class StudySettings(Record):
    """StudySettings."""

    cases: list[str]
    formats: list[str]
    levels: list[int]
    methods: list[str]
    sweep_bits: list[int] | None
    errors: str | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> StudySettings:
        """From JSON."""
        return cls(
            cases=data["cases"],
            formats=data["formats"],
            levels=data["levels"],
            methods=data["methods"],
            sweep_bits=data["sweep_bits"],
            errors=data.get("errors"),
        )


@dataclass(eq=False, repr=False)
class UnprovedOf(Record):
    """A statement of a case that is not proved."""

    case: str
    claim: str
    """The statement: "tau defined"."""
    reason: str
    """What became of it: "undecided near lambda = 11/7"."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> UnprovedOf:
        """From JSON."""
        return cls(
            case=data["case"],
            claim=data["claim"],
            reason=data["reason"],
        )


@dataclass(eq=False, repr=False)
class Study(Record):
    """Study."""

    rows: list[StudyRow]
    settings: StudySettings
    volver: str
    unproved: list[UnprovedOf] | None = None

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Study:
        """From JSON."""
        return cls(
            rows=[StudyRow.read(one) for one in data["rows"]],
            settings=StudySettings.read(data["settings"]),
            volver=data["volver"],
            unproved=None if data.get("unproved") is None else [UnprovedOf.read(one) for one in data["unproved"]],
        )


@dataclass(eq=False, repr=False)
class Uncertainty(Record):
    """Where the error of a plan comes from; all of it is at most the tolerance."""

    models: float
    """The bounds of all steps."""
    reference: float
    """What the radiance was known to when these were found."""
    rounding: float
    """What rounding does in the plan's format."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Uncertainty:
        """From JSON."""
        return cls(
            models=data["models"],
            reference=data["reference"],
            rounding=data["rounding"],
        )


@dataclass(eq=False, repr=False)
class CheckedChannel(Record):
    """One channel of it."""

    channel: str
    """Its name, empty where the scene names none."""
    error: float
    """How far they are apart."""
    radiance: str
    """What the plan gave, as it prints."""
    reference: str
    """The radiance to many digits."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> CheckedChannel:
        """From JSON."""
        return cls(
            channel=data["channel"],
            error=data["error"],
            radiance=data["radiance"],
            reference=data["reference"],
        )


@dataclass(eq=False, repr=False)
class Checked(Record):
    """What came of a plan when it was run, beside the radiance to many digits."""

    channels: list[CheckedChannel]
    """By channel."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Checked:
        """From JSON."""
        return cls(
            channels=[CheckedChannel.read(one) for one in data["channels"]],
        )


@dataclass(eq=False, repr=False)
class Plan(Record):
    """A plan as it is kept in a file: for one scene, in full."""

    evaluations: int
    """How often C and τ are evaluated."""
    format: str
    """The format that it is for."""
    plan: int
    """The version of this form."""
    scene: str
    """The fingerprint of the scene."""
    steps: list[dict[str, Any]]
    """From front to back, without gaps."""
    tolerance: float
    """What the radiance of every channel may be off by."""
    uncertainty: Uncertainty
    """What the plan itself errs by at most."""
    checked: Checked | None = None
    """What came of it; nothing before it was run."""
    stop: str | None = None
    """Where the ray may end: nothing behind it matters."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Plan:
        """From JSON."""
        return cls(
            evaluations=data["evaluations"],
            format=data["format"],
            plan=data["plan"],
            scene=data["scene"],
            steps=data["steps"],
            tolerance=data["tolerance"],
            uncertainty=Uncertainty.read(data["uncertainty"]),
            checked=None if data.get("checked") is None else Checked.read(data["checked"]),
            stop=data.get("stop"),
        )
