// Moving a camera by hand: around what it looks at, nearer and farther, and freely.
#pragma once

#include "scene/scene.h"

namespace redmap {

/// Turns the camera about the point that it looks at: `right` about its up direction, `up` over the top, not beyond it.
/// Its distance stays.
void orbit(Camera& camera, float right_degrees, float up_degrees);

/// Multiplies the distance to the point that it looks at by `factor`, above 0.
void zoom(Camera& camera, float factor);

/// Moves camera and point together, in its own directions and in parts of the distance between the two.
void fly(Camera& camera, float right, float up, float forward);

/// Turns the camera in place.
void look(Camera& camera, float right_degrees, float up_degrees);

}  // namespace redmap
