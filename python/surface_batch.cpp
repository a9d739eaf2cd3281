#include "surface_batch.h"

namespace redmap::python {

ShadingBatch batch_of(std::vector<SurfaceHit> hits, const RowsIn<3>& to_light, const RowsIn<3>& to_viewer) {
  ShadingBatch batch;
  const std::size_t count = hits.size();
  batch.hits = std::move(hits);
  batch.to_viewer = vectors_of<Vec3>("to_viewer", to_viewer, count);
  batch.lights.resize(1);
  batch.lights[0].to_light = vectors_of<Vec3>("to_light", to_light, count);
  batch.lights[0].irradiance.resize(count);
  batch.turned.resize(count), batch.frames.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    SurfaceHit& hit = batch.hits[i];
    batch.turned[i] = dot(hit.geometric_normal, batch.to_viewer[i]) < 0;
    if (batch.turned[i]) hit.normal = -hit.normal, hit.geometric_normal = -hit.geometric_normal;
    batch.frames[i] = {hit.tangent, cross(hit.normal, hit.tangent), hit.normal};
    batch.lights[0].irradiance.set(i, Vec3{1, 1, 1});
  }
  return batch;
}

RowsOut<3> shade_batch(const ObjectShading& shading, const ShadingBatch& batch) {
  ShadedBatch shaded;
  {
    const nb::gil_scoped_release release;
    RenderCounts counts;
    shading.shade(batch, shaded, counts);
  }
  return array_of(std::move(shaded.radiance));
}

}  // namespace redmap::python
