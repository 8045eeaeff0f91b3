"""A process that is a kernel itself, kernel.py's, and starts volver:

    caller.py VOLVER ARGUMENT... -- OPTION-OF-KERNEL...

Its exit code is volver's.
"""

import os
import runpy
import subprocess
import sys
import threading

split = sys.argv.index("--")
script = os.path.join(os.path.dirname(__file__), "kernel.py")
read_requests, write_requests = os.pipe()
read_answers, write_answers = os.pipe()
command = [*sys.argv[1:split], f"fd:{read_answers},{write_requests}"]
child = subprocess.Popen(command, pass_fds=(read_answers, write_requests))
os.close(write_requests)
os.close(read_answers)
# What kernel.py prints is not volver's.
nowhere = os.open(os.devnull, os.O_WRONLY)
os.dup2(nowhere, 1)
os.dup2(nowhere, 2)
os.close(nowhere)
# Where kernel.py looks for them; the lower one is moved first.
os.dup2(read_requests, 3)
os.dup2(write_answers, 4)
if write_answers != 4:
    os.close(write_answers)


def end():
    os._exit(child.wait())


threading.Thread(target=end, daemon=True).start()
sys.argv = [script, *sys.argv[split + 1 :]]
try:
    runpy.run_path(script, run_name="__main__")
except (SystemExit, OSError):
    pass
os.closerange(3, 5)
end()
