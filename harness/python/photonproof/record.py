"""Records: the file results.json that ``photonproof bench`` and ``photonproof gate`` write."""
from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Dict, List

from . import _native

if TYPE_CHECKING:
    import pandas


class Record:
    """A record, checked against its schema. docs/formats/records.md describes ``data``, its JSON."""

    def __init__(self, path: "str | os.PathLike[str]") -> None:
        """The path of results.json, or of the folder that holds it. Raises InputError where it is no whole record."""
        name = os.fspath(path)
        self.path: str = os.path.join(name, "results.json") if os.path.isdir(name) else name
        _native.check_record(self.path)
        with open(self.path, encoding="utf-8") as file:
            self.data: Dict[str, Any] = json.load(file)

    def rows(self) -> List[Dict[str, Any]]:
        """A row a cell: scene, engine, budget, seed, status, seconds, and a key ``metric.NAME`` for each metric."""
        rows: List[Dict[str, Any]] = []
        for result in self.data["results"]:
            cell = result["cell"]
            row: Dict[str, Any] = {
                "scene": cell["scene"], "engine": cell["engine"], "budget": cell["budget"]["kind"],
                "amount": cell["budget"]["amount"], "seed": cell["seed"], "status": result["status"]}
            for key in ("wall_seconds", "cpu_seconds", "peak_bytes", "instructions"):
                row[key] = result.get(key)
            row["detail"] = result.get("detail") or None
            row["image"] = result.get("image") or None
            for metric in result.get("metrics", []):
                row["metric." + metric["name"]] = metric["value"]
            for group in ("phases", "counts"):
                for key, value in (result.get(group) or {}).items():
                    row[f"{group}.{key}"] = value
            rows.append(row)
        return rows

    def gates(self) -> List[Dict[str, Any]]:
        """The gates' decisions, as the record has them."""
        return list(self.data.get("gates", []))

    def to_pandas(self) -> "pandas.DataFrame":
        """``rows()`` as a table. Needs pandas."""
        import pandas

        return pandas.DataFrame(self.rows())

    def gates_to_pandas(self) -> "pandas.DataFrame":
        """``gates()`` as a table: name, scene, engine, metric, verdict, sentence, bound and more. Needs pandas."""
        import pandas

        return pandas.DataFrame(self.gates())

    def __repr__(self) -> str:
        return f"<photonproof.Record {self.path}: {len(self.data['results'])} results, {len(self.gates())} gates>"
