"""The notebook and the guide's examples run, and print what they state."""
import os
import re
import shutil

import numpy as np
import pytest

import photonproof


def test_the_notebook_renders_compares_and_plots(sources, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    client = pytest.importorskip("nbclient")
    pytest.importorskip("matplotlib")
    file = sources / "docs" / "examples" / "python" / "first_steps.ipynb"
    if not file.exists():
        pytest.skip("the notebook is in the source tree alone")
    notebook = nbformat.read(file, as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells)  # none is committed
    client.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = {cell.id: cell.outputs for cell in notebook.cells if cell.cell_type == "code"}

    def text(name):
        return "".join(output.get("text", "") for output in outputs[name])

    def pictures(name):
        return [output for output in outputs[name] if "image/png" in output.get("data", {})]

    assert pictures("render") and pictures("plot")
    assert re.search(r"relmse +0\.0", text("compare"))
    passed, failed = text("agreement").splitlines()
    assert passed.startswith("pass: ") and failed.startswith("fail: ")


def test_the_guides_examples_run(sources, scenes, tmp_path, monkeypatch):
    guide = sources / "docs" / "guides" / "python.md"
    if not guide.exists():
        pytest.skip("the guide is in the source tree alone")
    monkeypatch.chdir(tmp_path)
    shutil.copytree(scenes / "cornell", tmp_path / "cornell")
    os.symlink(tmp_path / "cornell" / "scene.xml", tmp_path / "scene.xml")
    blocks = re.findall(r"```python\n(.*?)```", guide.read_text(), re.DOTALL)
    assert len(blocks) >= 4
    names = {"photonproof": photonproof, "np": np}
    for block in blocks:
        exec(compile(block, str(guide), "exec"), names)
