// Shadow rays out of a mesh, one at a time as MeshBody::length_inside traces them, in packets and as streams:
// from points in the torus knot towards points of a rectangle light. Every hit is taken down and refused, so
// that the traversal sees the whole line.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <vector>

#include "math/random.h"
#include "scene/mesh.h"

namespace meander {
namespace {

constexpr std::size_t kMost = 16;
constexpr std::size_t kRays = 4096;
constexpr std::size_t kStream = 64;

// The meetings of up to kStream lines. Embree hands the filter a pointer to the first member.
struct Gathering {
  RTCIntersectContext context;
  std::array<std::array<float, kMost>, kStream> met;
  std::array<std::uint32_t, kStream> count{};
};

void gather(const RTCFilterFunctionNArguments* args) {
  auto& gathering = *reinterpret_cast<Gathering*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t ray = RTCRayN_id(args->ray, args->N, i);
    std::uint32_t& count = gathering.count[ray];
    if (count == kMost) continue;
    gathering.met[ray][count++] = RTCRayN_tfar(args->ray, args->N, i);
    args->valid[i] = 0;
  }
}

// The knot, and rays from the middle of its tube's depth towards the light of
// tests/bench/scenes/lit_knot.toml.
struct Knot {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  std::vector<glm::vec3> positions;
  std::vector<RTCRay> rays;

  Knot() {
    const Mesh mesh = make_torus_knot();
    positions.assign(mesh.positions.begin(), mesh.positions.end());
    positions.emplace_back();
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(glm::vec3), positions.size() - 1);
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(
        scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcCommitScene(scene);
    Random random = stream(1, 0, 0);
    for (std::size_t i = 0; i < kRays; ++i) rays.push_back(ray_from(mesh, random));
  }
  ~Knot() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Knot(const Knot&) = delete;
  Knot& operator=(const Knot&) = delete;

  [[nodiscard]] static RTCRay ray_from(const Mesh& mesh, Random& random) {
    const auto number = static_cast<std::size_t>(random.next() * static_cast<Real>(mesh.triangles.size()));
    const Triangle& t = mesh.triangles[number];
    const DVec3 a = mesh.positions[t[0]];
    const DVec3 normal = glm::normalize(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
    const glm::vec3 p(a - 0.171 * double{random.next()} * normal);
    // The light's plane faces the origin, near enough.
    const glm::vec3 to(2 * random.next() - 1, 3.4f + 1.2f * (random.next() - 0.5f),
                       -2.6f + 1.6f * (random.next() - 0.5f));
    const glm::vec3 d = glm::normalize(to - p);
    return {p.x, p.y, p.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
  }
};

template <class RayN, std::size_t kWidth>
RayN packet_of(const RTCRay* rays) {
  RayN packet;
  for (std::size_t i = 0; i < kWidth; ++i) {
    packet.org_x[i] = rays[i].org_x;
    packet.org_y[i] = rays[i].org_y;
    packet.org_z[i] = rays[i].org_z;
    packet.dir_x[i] = rays[i].dir_x;
    packet.dir_y[i] = rays[i].dir_y;
    packet.dir_z[i] = rays[i].dir_z;
    packet.tnear[i] = 0;
    packet.time[i] = 0;
    packet.tfar[i] = rays[i].tfar;
    packet.mask[i] = ~0u;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
  return packet;
}

alignas(64) constexpr auto kAll = [] {
  std::array<int, 16> all{};
  all.fill(-1);
  return all;
}();

void trace(const Knot& knot, std::size_t width, const RTCRay* rays, Gathering& gathering) {
  if (width == 1) {
    RTCRay ray = rays[0];
    rtcOccluded1(knot.scene, &gathering.context, &ray);
  } else if (width == 8) {
    auto packet = packet_of<RTCRay8, 8>(rays);
    rtcOccluded8(kAll.data(), knot.scene, &gathering.context, &packet);
  } else if (width == 16) {
    auto packet = packet_of<RTCRay16, 16>(rays);
    rtcOccluded16(kAll.data(), knot.scene, &gathering.context, &packet);
  } else {
    std::array<RTCRay, kStream> stream;
    std::copy_n(rays, kStream, stream.begin());
    for (unsigned i = 0; i < kStream; ++i) stream[i].id = i;
    rtcOccluded1M(knot.scene, &gathering.context, stream.data(), kStream, sizeof(RTCRay));
  }
}

// Measured 2026-11-26 (AMD EPYC at 2.6 GHz, AVX-512, one core, medians of five, Mrays/s): one at a time 2.86,
// packets of 8 2.77, of 16 2.72, streams of 64 3.07; with the coherent flag 1.17, 1.10, 1.14. Of the lit
// knot's time Embree takes 41 %, so streams could save 3 % of it at most: shadow rays stay single.
//
// Rays a second; `meetings` a ray, of which every way must find the same.
void shadow_rays(benchmark::State& state) {
  static const Knot knot;
  const auto width = static_cast<std::size_t>(state.range(0));
  std::uint64_t meetings = 0;
  std::uint64_t traced = 0;
  for (auto _ : state) {
    for (std::size_t at = 0; at < kRays; at += width) {
      Gathering gathering;
      rtcInitIntersectContext(&gathering.context);
      gathering.context.filter = gather;
      if (state.range(1) != 0) gathering.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      trace(knot, width, &knot.rays[at], gathering);
      for (std::size_t i = 0; i < width; ++i) meetings += gathering.count[i];
    }
    traced += kRays;
  }
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(traced), benchmark::Counter::kIsRate);
  state.counters["meetings"] = static_cast<double>(meetings) / static_cast<double>(traced);
}
BENCHMARK(shadow_rays)->ArgNames({"width", "coherent"})->ArgsProduct({{1, 8, 16, kStream}, {0, 1}});

}  // namespace
}  // namespace meander
