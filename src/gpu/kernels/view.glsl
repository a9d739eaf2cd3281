// What things are seen from: the camera, band by band of its picture, and the faces of shadow maps. Pixels are those of
// the target that a view draws into; directions are unnormalised, one pixel's step at distance 1.
struct RedmapView {
  vec4 eye;       // w: 1 where rays are parallel and start side by side
  vec4 top_left;  // direction through the corner (0, 0); parallel rays: their direction. w: depth of what is nearest
  vec4 right;     // step to the next column; w: columns
  vec4 down;      // step to the next row; w: rows
  vec4 forward;   // unit; w: parallel rays: how far they reach
};

// x, y in pixels, and the distance along the view's axis.
vec3 redmap_pixel(RedmapView view, vec3 world) {
  vec3 q = world - view.eye.xyz;
  float z = dot(q, view.forward.xyz);
  vec3 across = view.eye.w > 0.5 ? q : q / z - view.top_left.xyz;
  return vec3(dot(across, view.right.xyz) / dot(view.right.xyz, view.right.xyz),
              dot(across, view.down.xyz) / dot(view.down.xyz, view.down.xyz), z);
}

// Greater is nearer: what is left of precision is spread evenly over all distances.
float redmap_depth(RedmapView view, float z) {
  return view.eye.w > 0.5 ? 1.0 - z / view.forward.w : view.top_left.w / z;
}

vec4 redmap_clip(RedmapView view, vec3 world) {
  vec3 q = world - view.eye.xyz;
  float z = dot(q, view.forward.xyz);
  bool parallel = view.eye.w > 0.5;
  vec3 across = parallel ? q : q - view.top_left.xyz * z;
  float x = dot(across, view.right.xyz) / dot(view.right.xyz, view.right.xyz);
  float y = dot(across, view.down.xyz) / dot(view.down.xyz, view.down.xyz);
  float w = parallel ? 1.0 : z;
  return vec4(2.0 * x / view.right.w - w, 2.0 * y / view.down.w - w,
              parallel ? 1.0 - z / view.forward.w : view.top_left.w, w);
}

struct RedmapRay {
  vec3 origin;
  vec3 direction;  // unit
};
RedmapRay redmap_view_ray(RedmapView view, vec2 pixel) {
  vec3 across = view.right.xyz * pixel.x + view.down.xyz * pixel.y;
  bool parallel = view.eye.w > 0.5;
  return RedmapRay(view.eye.xyz + (parallel ? across : vec3(0.0)),
                   normalize(view.top_left.xyz + (parallel ? vec3(0.0) : across)));
}
