"""A record's table has the record's numbers."""
import json

import pytest

import photonproof


@pytest.fixture(scope="module")
def folder(scenes, program, tmp_path_factory):
    place = tmp_path_factory.mktemp("bench")
    (place / "tiny.toml").write_text(f"""
name = "tiny"
title = "Tiny"
[[scene]]
name = "cornell"
path = "{scenes / 'cornell' / 'scene.xml'}"
width = 64
height = 64
[[run]]
engine = "path"
budgets = ["spp=2", "spp=4"]
seeds = [1, 2]
""")
    program("bench", "tiny.toml", "-o", "out", folder=place)
    return place / "out"


def test_a_table_has_a_row_a_cell(folder):
    table = photonproof.Record(folder).to_pandas()
    results = json.loads((folder / "results.json").read_text())["results"]
    assert len(table) == len(results) == 4 and set(table.status) == {"ok"}
    assert set(zip(table.engine, table.budget, table.amount, table.seed)) == {
        ("path", "spp", amount, seed) for amount in (2.0, 4.0) for seed in (1, 2)}
    for row, result in zip(table.to_dict("records"), results):
        for metric in result["metrics"]:
            assert row["metric." + metric["name"]] == metric["value"]
        assert row["cpu_seconds"] == result["cpu_seconds"]
        assert row["counts.rays_camera"] == result["counts"]["rays_camera"]
    assert table.groupby("amount")["metric.relmse"].mean().is_monotonic_decreasing
    assert "4 results" in repr(photonproof.Record(folder / "results.json"))


@pytest.mark.parametrize("change, says", [
    (lambda record: record.pop("results"), "results"), (lambda record: record.update(schema_version=99), "schema_version"),
    (lambda record: record["results"].append(record["results"][0]), "has two results")])
def test_a_damaged_record_is_an_error(folder, tmp_path, change, says):
    record = json.loads((folder / "results.json").read_text())
    change(record)
    (tmp_path / "results.json").write_text(json.dumps(record))
    with pytest.raises(photonproof.InputError, match=says):
        photonproof.Record(tmp_path)


def test_no_record_and_no_json_are_errors(tmp_path):
    with pytest.raises(photonproof.InputError):
        photonproof.Record(tmp_path / "none.json")
    (tmp_path / "results.json").write_text("{")
    with pytest.raises(photonproof.InputError):
        photonproof.Record(tmp_path)
