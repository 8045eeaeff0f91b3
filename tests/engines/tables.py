"""Reads study.parquet in a folder with DuckDB, Polars and pandas, compares it with study.csv, and runs the queries of docs/scale.md there.

usage: tables.py FOLDER DOCUMENT
"""
import csv
import math
import os
import re
import sys

import duckdb
import pandas
import polars

with open(sys.argv[2]) as file:
    document = file.read()
os.chdir(sys.argv[1])
with open("study.csv") as file:
    rows = list(csv.DictReader(file))
PARTS = ["total", "discretization", "truncation", "input_rounding", "arithmetic_rounding", "resolution"]
TEXTS = ["case", "method", "format", "state"]


def number(text):
    """As the file has it: null where there is none, or none of binary64's normal numbers."""
    x = float(text) if text else math.nan
    if math.isfinite(x) and (abs(x) >= sys.float_info.min or re.fullmatch("-?0", text)):
        return x
    return None


wanted = [(*(row[name] for name in TEXTS), int(row["bits"]), int(row["n"]), *(number(row[name]) for name in PARTS)) for row in rows]
columns = [*TEXTS, "bits", "n", *PARTS]
names = ", ".join(f'"{name}"' for name in columns)
by_duckdb = duckdb.sql(f"SELECT {names} FROM 'study.parquet'").fetchall()
by_polars = polars.read_parquet("study.parquet").select(columns).rows()
frame = pandas.read_parquet("study.parquet")[columns]
by_pandas = [tuple(None if isinstance(x, float) and math.isnan(x) else x for x in row) for row in frame.itertuples(index=False, name=None)]
for engine, found in [("DuckDB", by_duckdb), ("Polars", by_polars), ("pandas", by_pandas)]:
    if len(found) != len(wanted):
        sys.exit(f"{engine}: {len(found)} rows, not {len(wanted)}")
    for ours, theirs in zip(wanted, found):
        # Its reader rounds the twenty digits of the other file; so does ours.
        if ours != tuple(theirs):
            sys.exit(f"{engine}: {theirs}, not {ours}")
keys = {row[0] for row in duckdb.sql("SELECT key FROM 'study.parquet'").fetchall()}
units = {(row["case"], row["format"]) for row in rows}
assert len(keys) == len(units) and all(0 <= key < 2**63 for key in keys), keys
flags = duckdb.sql("SELECT count(*) FROM 'study.parquet' WHERE (total IS NULL) <> (failed OR infinite OR beyond_binary64)").fetchall()
assert flags == [(0,)], flags

query, = re.findall(r"```sql\n(.*?)```", document, re.S)
assert len(duckdb.sql(query.strip().rstrip(";")).fetchall()) == len({(row["case"], row["method"], row["format"]) for row in rows})
script, = re.findall(r"```python\n(.*?)```", document, re.S)
exec(script)
assert shares.height == len({(row["case"], row["method"], row["format"]) for row in rows}), shares
