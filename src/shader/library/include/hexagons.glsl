// A hexagonal tiling of the plane: centres one unit apart along x, rows sqrt(3)/2 apart, odd rows shifted by half.
#ifndef REDMAP_HEXAGONS_GLSL
#define REDMAP_HEXAGONS_GLSL

struct Hexagon {
  float column;
  float row;
  float edge;  // second smallest minus smallest squared distance to a centre: 0 on the edges, 1 at the centre
};

Hexagon hexagon_at(float x, float y) {
  const float row_height = 0.8660254;
  float nearest = 1e9;
  float second = 1e9;
  float column = 0.0;
  float row = 0.0;
  float first_row = floor(y * (1.0 / row_height));
  for (int j = -1; j <= 2; j++) {
    float r = first_row + float(j);
    float shift = 0.5 * mod(r, 2.0);
    float first_column = floor(x - shift);
    for (int i = 0; i <= 1; i++) {
      float c = first_column + float(i);
      float dx = x - (c + shift);
      float dy = y - r * row_height;
      float distance2 = dx * dx + dy * dy;
      bool is_nearest = distance2 < nearest;
      second = min(second, max(distance2, nearest));
      nearest = min(nearest, distance2);
      column = mix(column, c, is_nearest);
      row = mix(row, r, is_nearest);
    }
  }
  return Hexagon(column, row, second - nearest);
}

// The tiling wrapped around the y axis, `around` columns in a turn and `rows` units of it in a unit of height.
Hexagon hexagon_around_y(vec3 position, float around, float rows) {
  return hexagon_at(atan(position.z, position.x) * (around / (2.0 * pi)), position.y * rows);
}

#endif
