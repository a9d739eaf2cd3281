#include "render/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "surface/mesh.h"

namespace redmap {

namespace {

constexpr unsigned kPacket = 8;  // rays traced together: the widest packet without AVX-512

struct Handles {
  RTCDevice device = nullptr;
  std::vector<RTCScene> surfaces;  // one per object
  std::vector<RTCGeometry> instances;
  RTCScene world = nullptr;
};

Ray packet_ray(RTCRayN* rays, unsigned size, unsigned i) {
  return {{RTCRayN_org_x(rays, size, i), RTCRayN_org_y(rays, size, i), RTCRayN_org_z(rays, size, i)},
          {RTCRayN_dir_x(rays, size, i), RTCRayN_dir_y(rays, size, i), RTCRayN_dir_z(rays, size, i)},
          RTCRayN_tnear(rays, size, i),
          RTCRayN_tfar(rays, size, i)};
}

void analytic_bounds(const RTCBoundsFunctionArguments* args) {
  const auto* surface = static_cast<const Surface*>(args->geometryUserPtr);
  const Vec3 lo = surface->lower(), hi = surface->upper();
  *args->bounds_o = {lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, 0};
}

void analytic_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto* surface = static_cast<const Surface*>(args->geometryUserPtr);
  const unsigned size = args->N;
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, size);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, size);
  for (unsigned i = 0; i < size; ++i) {
    if (!args->valid[i]) continue;
    const Ray ray = packet_ray(rays, size, i);
    const auto hit = surface->intersect(ray.origin, ray.direction, ray.t_near, ray.t_far);
    if (!hit) continue;
    RTCRayN_tfar(rays, size, i) = hit->t;
    RTCHitN_Ng_x(hits, size, i) = hit->geometric_normal.x;
    RTCHitN_Ng_y(hits, size, i) = hit->geometric_normal.y;
    RTCHitN_Ng_z(hits, size, i) = hit->geometric_normal.z;
    RTCHitN_u(hits, size, i) = hit->where.coordinates.x;
    RTCHitN_v(hits, size, i) = hit->where.coordinates.y;
    RTCHitN_primID(hits, size, i) = hit->where.primitive;
    RTCHitN_geomID(hits, size, i) = args->geomID;
    for (unsigned level = 0; level < RTC_MAX_INSTANCE_LEVEL_COUNT; ++level)
      RTCHitN_instID(hits, size, i, level) = args->context->instID[level];
  }
}

void analytic_occluded(const RTCOccludedFunctionNArguments* args) {
  const auto* surface = static_cast<const Surface*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    const Ray ray = packet_ray(args->ray, args->N, i);
    if (surface->intersect(ray.origin, ray.direction, ray.t_near, ray.t_far))
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

RTCGeometry make_triangles(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                           mesh.positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle),
                                          mesh.triangles.size());
  if (!vertices || !indices) throw Error("not enough memory to trace a mesh of {} triangles", mesh.triangles.size());
  std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
  std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
  return geometry;
}

RTCGeometry make_analytic(RTCDevice device, const Surface& surface) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<Surface*>(&surface));
  rtcSetGeometryBoundsFunction(geometry, analytic_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, analytic_intersect);
  rtcSetGeometryOccludedFunction(geometry, analytic_occluded);
  return geometry;
}

RTCScene make_surface_scene(RTCDevice device, const Surface& surface) {
  RTCScene scene = rtcNewScene(device);
  // Robust: rays that graze shared edges of far-away meshes must not slip through.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = surface.mesh() ? make_triangles(device, *surface.mesh()) : make_analytic(device, surface);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

template <typename Packet>
void load_ray(Packet& packet, unsigned lane, const Ray& ray) {
  packet.org_x[lane] = ray.origin.x, packet.org_y[lane] = ray.origin.y, packet.org_z[lane] = ray.origin.z;
  packet.dir_x[lane] = ray.direction.x, packet.dir_y[lane] = ray.direction.y, packet.dir_z[lane] = ray.direction.z;
  packet.tnear[lane] = ray.t_near, packet.tfar[lane] = ray.t_far;
  packet.time[lane] = 0, packet.mask[lane] = ~0u, packet.id[lane] = 0, packet.flags[lane] = 0;
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

struct Tracer::Embree : Handles {
  ~Embree() {
    for (RTCGeometry instance : instances) rtcReleaseGeometry(instance);
    for (RTCScene scene : surfaces) rtcReleaseScene(scene);
    if (world) rtcReleaseScene(world);
    if (device) rtcReleaseDevice(device);
  }
};

Tracer::Tracer(const Scene& scene) : embree_(std::make_unique<Embree>()), placements_(scene.objects.size()) {
  // No "threads=": Embree would limit all of TBB to as many.
  embree_->device = rtcNewDevice("set_affinity=0");
  if (!embree_->device) throw Error("the ray tracer Embree did not start (error {})", int(rtcGetDeviceError(nullptr)));
  embree_->world = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->world, RTC_SCENE_FLAG_ROBUST);
  for (const Object& object : scene.objects) {
    surfaces_.push_back(object.surface);
    embree_->surfaces.push_back(make_surface_scene(embree_->device, *object.surface));
    RTCGeometry instance = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, embree_->surfaces.back());
    rtcAttachGeometryByID(embree_->world, instance, static_cast<unsigned>(embree_->instances.size()));
    embree_->instances.push_back(instance);
  }
}

Tracer::~Tracer() = default;

void Tracer::set_frame(const Scene& scene) {
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const Placement p = placements_[i] = make_placement(scene.objects[i].transform);
    const Vec3 x = p.rotation.x * p.scale, y = p.rotation.y * p.scale, z = p.rotation.z * p.scale, t = p.translate;
    const float columns[12] = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, t.x, t.y, t.z};
    rtcSetGeometryTransform(embree_->instances[i], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(embree_->instances[i]);
  }
  rtcCommitScene(embree_->world);
}

void Tracer::intersect(std::span<const Ray> rays, std::span<RayHit> hits) const {
  RTCIntersectContext context = coherent_context();
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const unsigned count = static_cast<unsigned>(std::min<std::size_t>(kPacket, rays.size() - first));
    alignas(32) int valid[kPacket];
    RTCRayHit8 packet;
    for (unsigned lane = 0; lane < kPacket; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
      load_ray(packet.ray, lane, rays[first + std::min(lane, count - 1)]);
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, embree_->world, &context, &packet);
    for (unsigned lane = 0; lane < count; ++lane) {
      const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      hits[first + lane] = {hit ? packet.hit.instID[0][lane] : kNoObject,
                            {packet.hit.primID[lane], {packet.hit.u[lane], packet.hit.v[lane]}},
                            packet.ray.tfar[lane],
                            {packet.hit.Ng_x[lane], packet.hit.Ng_y[lane], packet.hit.Ng_z[lane]}};
    }
  }
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  RTCIntersectContext context = coherent_context();
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const unsigned count = static_cast<unsigned>(std::min<std::size_t>(kPacket, rays.size() - first));
    alignas(32) int valid[kPacket];
    RTCRay8 packet;
    for (unsigned lane = 0; lane < kPacket; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
      load_ray(packet, lane, rays[first + std::min(lane, count - 1)]);
    }
    rtcOccluded8(valid, embree_->world, &context, &packet);
    for (unsigned lane = 0; lane < count; ++lane) blocked[first + lane] = packet.tfar[lane] < 0;
  }
}

}  // namespace redmap
