"""Checks a manifest against the schemas of two versions of Kubernetes, and runs what its pods run, one index after the other."""
import os
import subprocess
import sys

import kubernetes_validate
import yaml

VERSIONS = ["1.25", "1.37"]

with open(sys.argv[1]) as file:
    job = yaml.safe_load(file)
for version in VERSIONS:
    kubernetes_validate.validate(job, version, strict=True)
broken = yaml.safe_load(open(sys.argv[1]))
broken["spec"]["completion"] = broken["spec"].pop("completions")
for version in VERSIONS:
    try:
        kubernetes_validate.validate(broken, version, strict=True)
    except kubernetes_validate.ValidationError:
        continue
    sys.exit(f"the schema of {version} sees nothing wrong with a key that there is not")
spec = job["spec"]
assert spec["completionMode"] == "Indexed", spec
container, = spec["template"]["spec"]["containers"]
environment = {pair["name"]: pair["value"] for pair in container["env"]}
for index in range(spec["completions"]):
    environment["JOB_COMPLETION_INDEX"] = str(index)
    subprocess.run(container["command"], cwd=container["workingDir"], env={**os.environ, **environment}, check=True)
