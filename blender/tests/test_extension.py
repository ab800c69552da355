"""The archive: Blender's own tools accept and install it, with the wheel."""

import importlib.util
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import bpy
import pytest

ROOT = Path(__file__).parents[2]
WHEEL = os.environ.get("WHEEL", "")
INSTALL = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
assert "bl_ext.user_default.throng" in [addon.module for addon in bpy.context.preferences.addons]
scene = bpy.context.scene
scene.throng.scene, scene.throng.seconds = "headon", 1
bpy.ops.throng.run_scene()
assert bpy.data.objects["Agent_0"].type == "ARMATURE"
from pathlib import Path
wheels = Path(sys.argv[2], "extensions", ".local")
assert list(wheels.glob("lib/python3.*/site-packages/throng_sim/_throng*"))
bpy.ops.preferences.addon_disable(module="bl_ext.user_default.throng")
assert not hasattr(bpy.types.Scene, "throng")
print("installed")
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if not WHEEL:
        pytest.skip("WHEEL names no wheel")
    folder = tmp_path_factory.mktemp("archive")
    made = subprocess.check_output([sys.executable, ROOT / "blender/build", WHEEL, folder], text=True)
    return Path(made.strip())


def test_blender_accepts_it(archive: Path) -> None:
    spec = importlib.util.find_spec("bpy")
    tool = next(Path(spec.origin).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    done = subprocess.run([sys.executable, tool, "validate", archive], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_blender_installs_it(archive: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", INSTALL, archive, tmp_path], env=environment, capture_output=True, text=True
    )
    assert "installed" in done.stdout, done.stdout + done.stderr


def test_other_files_are_refused(tmp_path: Path) -> None:
    wrong = tmp_path / "throng_sim-0.1.0-cp39-cp39-linux_x86_64.whl"
    wrong.write_bytes(b"")
    done = subprocess.run([sys.executable, ROOT / "blender/build", wrong], capture_output=True, text=True)
    assert done.returncode == 1 and "is not a wheel of throng-sim for all Pythons from 3.11" in done.stderr


def test_the_version_is_that_of_the_workspace() -> None:
    manifest = tomllib.loads((ROOT / "blender/throng/blender_manifest.toml").read_text())
    assert manifest["version"] == tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert tuple(map(int, manifest["blender_version_min"].split("."))) <= bpy.app.version
