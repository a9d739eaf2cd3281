"""redmap: mip-maps for procedural shaders (Van Horn and Turk 2008).

    scene = redmap.load_scene("scene.toml").at(1)
    maps = [redmap.bake(o.surface, o.shader, size=o.map_size) for o in scene.objects]
    redmap.write_image("out.png", redmap.render(scene, maps))
"""

import os
import sys

from ._core import *

# Whom the library asks about MaterialX: this Python, unless another was chosen.
os.environ.setdefault("REDMAP_PYTHON", sys.executable)
