// Limits of the integrals over distributions of normals, the same on the CPU and on devices.
#pragma once

namespace redmap {

/// Below this the light shines from behind the viewer's back and there is no half vector worth the name.
inline constexpr float kShortestHalf = 0.05f;
/// Distributions whose mean leans farther from the half vector see no highlight.
inline constexpr float kLeastFacing = 0.1f;
/// The z of mean normals is at least this: nothing is seen of steeper ones.
inline constexpr float kLeastMeanZ = 0.1f;
/// A fit that is off by more is better left as it is.
inline constexpr float kLargestScale = 2;
/// Parts of the radiance that the spread of normals may change before the mean normal says little about the highlight.
/// An error of a tenth of the model is about 1/255 there. Between the two both are asked, which is a call more: of the
/// lookups 6 % (16 % from .04 to .15, for half a percent less error).
inline constexpr float kCorrectedUpTo = 0.08f, kCalibratedFrom = 0.12f;
/// Spreads of normals, in parts of the narrowest highlight, over which they come to count: a highlight changes by 1/200
/// at the first, and little by little, so that nothing pops.
inline constexpr float kSpreadBegin = 0.07f, kSpreadEnd = 0.12f;
/// Spreads, in parts of the narrowest highlight, up to which a device asks at two normals each way, and then at three,
/// instead of integrating a model; the last where frames are to be fast. By the remainders of the rules, two are off
/// from a Gaussian by .1 % of a highlight's peak at .25, three by .3 % at .55: less than models are, so that beyond .15
/// pictures differ from those by models by more than .001 where highlights are as narrow as chrome's.
inline constexpr float kTwoNormals = 0.25f, kFewNormals = 0.15f, kFewNormalsFast = 0.55f;
/// Normals that are drawn lie within this of the frame's z axis, as a sine.
inline constexpr float kSteepest = 0.98f;
/// Spreads, in radians, of turns of a grain and of normals that one of each stands for.
inline constexpr float kOneDrawnTurn = 0.03f, kOneDrawnNormal = 0.003f;

}  // namespace redmap
