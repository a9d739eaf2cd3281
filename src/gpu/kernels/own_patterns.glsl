// Parameters and bound patterns of the object's text in the renderer's own memory.
layout(std430, binding = 5) readonly buffer RedmapParameters { Parameters redmap_parameters; };
layout(std430, binding = 6) buffer RedmapPatterns { REDMAP_BOUND redmap_patterns[]; };

