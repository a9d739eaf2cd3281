// Limits of shading by a map and of its lookups, the same on the CPU and on devices.
#pragma once

namespace redmap {

/// Footprints, in texels along the major axis, over which the shader gives way to the map.
inline constexpr float kBlendBegin = 0.5f, kBlendEnd = 1.0f;
/// Footprints around which the surface turns farther than this, as a variance, are no longer one tangent plane.
inline constexpr float kLargestTurn = 0.1f;
/// Rays that graze would reach infinitely far: they stop at 1 / this times the width.
inline constexpr float kLeastCosine = 1e-3f;

/// Footprints longer than this are widened instead: 16 is what texture hardware does, and beyond it errors no longer
/// fall.
inline constexpr float kLookupAnisotropy = 16;
/// Distance of two taps in texels of their level, at most: with the tent and box of a tap, 1.5 leaves no ripple that
/// shows.
inline constexpr float kTapSpacing = 1.5f;
/// A bilinear tap on box-filtered texels of width c has variance c^2 / 12 + c^2 / 6 = c^2 / 4; a box of width m has
/// m^2 / 12. They match at c = m / sqrt 3.
inline constexpr float kTexelPerMinor = 0.57735027f;
/// Taps that kLookupAnisotropy and kTapSpacing lead to at most: 16 sqrt 3 / 1.5 + .5, rounded up.
inline constexpr float kMaxTaps = 19;

/// Texels across a footprint from which clusters of the surface take over from its atlas. Solid noise on the 10k bunny,
/// footprints of 16 texels: error .021 from 8 on, .043 from 16 on.
inline constexpr float kClustersBegin = 8;
/// Where the kernel over clusters ends: 1 - r^2 / 6 over a disc has unit variance along each axis.
inline constexpr float kClusterSupport = 6;
/// How fast clusters come to count as they turn to the footprint's side.
inline constexpr float kClusterSideSlope = 4;
/// Keeps the kernel's matrix regular where the footprint is a line.
inline constexpr float kClusterRound = 1e-3f;

/// Raw texels that are gathered: footprints longer than this are widened, so that they stay few.
inline constexpr float kGatherAnisotropy = 6;
/// And narrower ones than this part of a base texel too.
inline constexpr float kGatherLeastWidth = 0.5f;
/// From this part of the way between two levels on they are mixed, so that nothing pops.
inline constexpr float kGatherBlendFrom = 0.6f;
/// Texels across a footprint whose normals are gathered, at least: measured, docs/normals.md.
inline constexpr float kGatheredTexels = 2;

/// Texels whose grains are gathered: within one there are two turns at most.
inline constexpr float kGatheredGrainTexels = 4;
/// Length of the mean of twice the angle from which on a texel has one turn: less than 10 degrees apart, which bytes do
/// not tell from nothing.
inline constexpr float kOneTurn = 0.985f;

/// Coverage from which nothing is mended at seams: a twentieth that is missing moves the mean by a fortieth of the
/// footprint, and mending less of it gains nothing.
inline constexpr float kWholeCoverage = 0.95f;
/// Nor is anything for footprints that reach less far, in texels.
inline constexpr float kLeastMendedReach = 2;
/// Pieces a side that a footprint is cut into at seams. On the bunny, footprints of 8 texels beside seams: RMS error
/// .0129 with one piece, .0038 with 3 x 3, .0033 with 4 x 4.
inline constexpr int kSeamPieces = 3;

}  // namespace redmap
