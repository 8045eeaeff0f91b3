"""A function that is interrupted where nobody waits for it any longer."""

from __future__ import annotations

import signal
import subprocess
import threading
import time
from collections.abc import Callable
from types import FrameType
from typing import Any, TypeVar

T = TypeVar("T")

#: how long a function is left alone between two interruptions, in seconds
PATIENCE = 1.0


class Guard:
    """Calls a function, and interrupts it where the program has ended and waits for it no longer."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self._process = process
        self._lock = threading.Lock()
        self._thread = threading.get_ident()
        self._is_main = threading.current_thread() is threading.main_thread()
        self._running = False
        self._urgent = False
        self._ended = False
        self.interrupted = False
        self._watcher = threading.Thread(target=self._watch, name="volver", daemon=True)
        self._watcher.start()

    def call(self, function: Callable[[Any], T], argument: Any) -> T:
        """What it returns."""
        try:
            with self._lock:
                if self._ended:
                    raise Ended
                self._running = True
            try:
                result = self._called(function, argument)
            finally:
                with self._lock:
                    self._running = False
            if self.interrupted:
                # The interruption is on its way still.
                time.sleep(PATIENCE)
        except (KeyboardInterrupt, _Interruption):
            with self._lock:
                self._running = False
            if not self.interrupted:
                raise
        if self.interrupted:
            raise Ended
        return result

    def _called(self, function: Callable[[Any], T], argument: Any) -> T:
        """What it returns; where SIGINT is ignored, as in jobs in the background, another signal ends what waits."""
        if not self._is_main or signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
            return function(argument)
        before = signal.signal(signal.SIGURG, _raise)
        self._urgent = True
        try:
            return function(argument)
        finally:
            self._urgent = False
            signal.signal(signal.SIGURG, before)

    def _watch(self) -> None:
        self._process.wait()
        while True:
            with self._lock:
                self._ended = True
                if not self._running:
                    return
                self.interrupted = True
                self._interrupt()
            time.sleep(PATIENCE)

    def _interrupt(self) -> None:
        if self._is_main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            # A signal ends what waits in the system, too.
            signal.pthread_kill(self._thread, signal.SIGINT)
            return
        if self._urgent:
            signal.pthread_kill(self._thread, signal.SIGURG)
            return
        import ctypes

        # The function may have returned meanwhile; what is raised then is caught where it was called.
        thread = ctypes.c_ulong(self._thread)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(_Interruption))


class Ended(BaseException):
    """The program has ended while the function ran; no function catches it by chance."""


class _Interruption(BaseException):
    pass


def _raise(number: int, frame: FrameType | None) -> None:
    raise _Interruption
