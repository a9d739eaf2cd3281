// One function a figure, each in the file of its name.
#pragma once

#include "laboratory.h"
#include "report.h"

namespace redmap::bench {

Figure measure_fig1(Laboratory& laboratory);   ///< the scene of many shaders
Figure measure_fig4(Laboratory& laboratory);   ///< transparent and bumpy
Figure measure_fig5(Laboratory& laboratory);   ///< sizes
Figure measure_fig6(Laboratory& laboratory);   ///< where the paper's rule supersamples
Figure measure_fig7(Laboratory& laboratory);   ///< four textures, near and far
Figure measure_fig8(Laboratory& laboratory);   ///< rotations: texture calls and seconds
Figure measure_fig9(Laboratory& laboratory);   ///< overhead with a white shader
Figure measure_fig10(Laboratory& laboratory);  ///< bakes
Figure measure_fig11(Laboratory& laboratory);  ///< the checkerboard on a device

Figure measure_curves(Laboratory& laboratory);    ///< error against time and against distance
Figure measure_flickers(Laboratory& laboratory);  ///< error in motion
Figure measure_analysis(Laboratory& laboratory);  ///< directions, PCA, blocks, weight bits
Figure measure_filters(Laboratory& laboratory);   ///< isotropic against anisotropic footprints
Figure measure_stages(Laboratory& laboratory);    ///< sampling error apart from fit error

}  // namespace redmap::bench
