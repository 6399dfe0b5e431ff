"""The table of cases in study_cases.parquet, as pandas writes it: numbers, whole numbers and texts (pandas 2.3, pyarrow 26)."""

import pandas

cases = pandas.DataFrame({"case": ["light", "heavy"], "W": [100.0, 250.5], "member": [1, 2], "note": ["spring", "Spring"]})
cases.to_parquet("tests/data/study_cases.parquet", index=False)
