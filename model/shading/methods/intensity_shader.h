// Flat, Gouraud and exact Phong shading of everything the scene format describes: any lights,
// either viewer, either highlight.
#pragma once

#include <memory>

#include "model/shading/methods/shading_method.h"

namespace phongpipe {

std::unique_ptr<TriangleShader> create_flat(const ShaderContext& context);
std::unique_ptr<TriangleShader> create_gouraud(const ShaderContext& context);
std::unique_ptr<TriangleShader> create_phong(const ShaderContext& context);

}  // namespace phongpipe
