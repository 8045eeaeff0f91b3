"""Arrays of NumPy, PyTorch and JAX: how rays become them, and answers become NumPy's again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ._errors import MissingError, RenderError, VolverError

#: what a kernel declares that computes in them
FORMATS = {"float16": "f16", "bfloat16": "bf16", "float32": "f32", "float64": "f64"}
LIBRARIES = ("numpy", "torch", "jax")


class Arrays:
    """A library of arrays, a type of their numbers, a device."""

    def __init__(self, library: str, dtype: Any, device: Any) -> None:
        if library not in LIBRARIES:
            raise VolverError(f"xp='{library}' (allowed: 'numpy', 'torch', 'jax')")
        if device is not None and library != "torch":
            raise VolverError(f"device='{device}' with xp='{library}' (allowed: with xp='torch')")
        self.library = library
        self.dtype = _name(dtype)
        self.device = device
        numpy()
        if library == "numpy":
            self.dtype = self.dtype or "float64"
            if self.dtype == "bfloat16":
                raise VolverError("dtype='bfloat16' with xp='numpy' (allowed: with xp='torch' or 'jax')")
            self.convert = self._numpy()
        elif library == "torch":
            self.dtype = self.dtype or "float64"
            self.convert = self._torch()
        else:
            self.convert = self._jax()

    @property
    def format(self) -> str:
        """The format that the numbers have."""
        return FORMATS[self.dtype]

    def _numpy(self) -> Callable[[Any], Any]:
        if self.dtype == "float64":
            return lambda values: values
        kind = numpy().dtype(self.dtype)
        return lambda values: values.astype(kind)

    def _torch(self) -> Callable[[Any], Any]:
        torch = _imported("torch", "PyTorch")
        kind, device, from_numpy = getattr(torch, self.dtype), self.device, torch.from_numpy
        if kind is torch.float64 and device is None:
            return lambda values: from_numpy(values)
        return lambda values: from_numpy(values).to(dtype=kind, device=device)

    def _jax(self) -> Callable[[Any], Any]:
        jnp = _imported("jax.numpy", "JAX")
        # Without jax_enable_x64 JAX makes binary32 of binary64, silently: what is declared is what it made.
        made = str(jnp.asarray(numpy().zeros(1)).dtype)
        self.dtype = self.dtype or made
        if self.dtype == "float64" and made != "float64":
            raise VolverError("dtype='float64' with JAX in binary32 (allowed: with jax_enable_x64, or dtype='float32')")
        kind = getattr(jnp, self.dtype)
        return lambda values: jnp.asarray(values, dtype=kind)

    def answer(self, what: str, value: Any, shapes: tuple[tuple[int, ...], ...], where: Callable[[], str]) -> Any:
        """The numbers of an answer in binary64, of the first of the shapes; any of them will do."""
        np = numpy()
        if type(value) is not np.ndarray:
            value = self._local(what, value, where)
        kind = str(value.dtype)
        if kind != self.dtype and not (what == "segments" and value.dtype.kind == "i"):
            other = f", or dtype='{kind}' in the call" if kind in FORMATS else ""
            raise RenderError(f"{what} of {kind} {where()} (allowed: {self.dtype}, as the rays have{other})")
        if value.shape not in shapes:
            allowed = " or ".join(map(str, shapes))
            raise RenderError(f"{what} of shape {value.shape} {where()} (allowed: {allowed})")
        if value.dtype.kind == "i":
            return value.astype(np.int64).reshape(shapes[0])
        return value.astype(np.float64, copy=False).reshape(shapes[0])

    def _local(self, what: str, value: Any, where: Callable[[], str]) -> Any:
        """As NumPy's array."""
        np = numpy()
        device = getattr(value, "device", None)
        kind = getattr(device, "type", "cpu")
        if kind != "cpu" and (self.device is None or kind == "meta"):
            raise RenderError(
                f"{what} on the device '{device}' {where()} (allowed: on the CPU, as {what}.cpu(); or device= in the call)"
            )
        if hasattr(value, "detach"):
            value = value.detach().cpu()
            # NumPy has no bfloat16; binary32 has all its numbers.
            if str(value.dtype) == "torch.bfloat16":
                return _Renamed(value.float().numpy(), "bfloat16")
        if isinstance(value, float) and self.dtype == "float64":
            return np.float64(value)
        if isinstance(value, (list, tuple)):
            value = [self._local(what, one, where) for one in value]
        try:
            made = np.asarray(value)
        except (TypeError, ValueError, RuntimeError) as error:
            said = str(error).splitlines()[0] if str(error) else type(error).__name__
            raise RenderError(f"{what} of {type(value).__name__} {where()}: {said} (allowed: arrays of numbers)") from None
        if made.dtype.kind == "O":
            raise RenderError(f"{what} of {type(value).__name__} {where()} (allowed: arrays of numbers)")
        return made


class _Renamed:
    """NumPy's array in place of one whose type it does not have."""

    def __init__(self, values: Any, dtype: str) -> None:
        self.values = values
        self.dtype = _Kind(dtype)
        self.shape = values.shape

    def astype(self, dtype: Any, copy: bool = True) -> Any:
        return self.values.astype(dtype)


class _Kind:
    kind = "f"

    def __init__(self, name: str) -> None:
        self.name = name

    def __str__(self) -> str:
        return self.name


def numpy() -> Any:
    """NumPy, or one line."""
    try:
        import numpy
    except ImportError:
        raise MissingError("NumPy is not installed (allowed: pip install numpy)") from None
    return numpy


def _imported(name: str, words: str) -> Any:
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError:
        package = name.partition(".")[0]
        raise MissingError(f"{words} is not installed (allowed: pip install {package})") from None


def _name(dtype: Any) -> str:
    """The name of NumPy's, PyTorch's or JAX's type of numbers; empty for none."""
    if dtype is None:
        return ""
    if isinstance(dtype, type):
        name = dtype.__name__
    else:
        name = str(getattr(dtype, "name", dtype)).removeprefix("torch.")
    name = {"float": "float64"}.get(name, name)
    if name not in FORMATS:
        raise VolverError(f"dtype='{name}' (allowed: {', '.join(FORMATS)})")
    return name
