"""pyarrow reads what throng wrote: python parquet.py RUN.parquet RUN.csv (of the same run)."""
import csv
import json
import sys

import pyarrow.parquet as pq

table, rows = pq.read_table(sys.argv[1]), list(csv.DictReader(open(sys.argv[2], newline="")))
metadata = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
assert table.num_rows == len(rows), (table.num_rows, len(rows))
for name in rows[0]:
    column = table[name].to_pylist()
    if isinstance(column[0], str):
        assert column == [row[name] for row in rows], name
    else:
        # single numbers are written with their own digits
        worst = max(abs(a - float(row[name])) / max(1, abs(a)) for a, row in zip(column, rows))
        assert worst < 1e-6, (name, worst)
assert set(table["group"].to_pylist()) <= set(json.loads(metadata["throng.groups"]))
file = pq.ParquetFile(sys.argv[1])
size = sum(
    file.metadata.row_group(g).column(c).total_compressed_size
    for g in range(file.num_row_groups) for c in range(file.metadata.num_columns)
)
print(f"{table.num_rows} rows equal, {file.num_row_groups} groups of rows, {size / table.num_rows:.1f} bytes a row")
print({key: value[:60] for key, value in metadata.items()})
