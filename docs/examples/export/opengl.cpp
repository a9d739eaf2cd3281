// A map that `redmap export --to glsl` wrote, drawn by OpenGL 3.3 without a window (EGL): the function redmap_shade()
// of its include file does all the shading. Build: c++ -std=c++20 opengl.cpp -lEGL -lOpenGL usage: opengl FOLDER
// MANIFEST_NUMBERS DISTANCE PIXELS OUT.pfm, the numbers being width height layers levels wraps_u rows vertices indices
// of manifest.json.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 p; layout(location = 1) in vec3 n; layout(location = 2) in vec3 t; layout(location = 3) in vec2 u;
layout(location = 4) in float f;
uniform float distance_;  // of the eye on +z, which looks at the origin through 40 degrees
out vec3 position, normal, tangent; out vec2 uv; flat out uint triangle;
void main() {
  position = p; normal = n; tangent = t; uv = u; triangle = uint(f);
  float z = distance_ - p.z;
  gl_Position = vec4(p.xy / tan(radians(20.0)), z - 0.2, z);
})";
const char* kFragment = R"(
in vec3 position, normal, tangent; in vec2 uv; flat in uint triangle;
uniform float distance_;
out vec4 color;
void main() {
  vec3 to_viewer = normalize(vec3(0.0, 0.0, distance_) - position);
  RedmapHit hit = redmap_seen(position, normal, tangent, uv, to_viewer, triangle);
  color = vec4(redmap_shade(hit, normalize(vec3(0.4, 0.5, 0.7)), vec3(3.0)), 1.0);
})";

int main(int, char** arguments) {
  const std::string folder = arguments[1];
  const auto number = [&](int i) { return std::stoi(arguments[2 + i]); };
  const int width = number(0), height = number(1), layers = number(2), levels = number(3), pixels = number(9);
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  eglInitialize(display, nullptr, nullptr);
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                 eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted));
  // The include file stands between the version and the program's own text.
  const GLuint program = glCreateProgram();
  const auto compile = [&](GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr), glCompileShader(shader), glAttachShader(program, shader);
  };
  compile(GL_VERTEX_SHADER, kVertex);
  compile(GL_FRAGMENT_SHADER, "#version 330 core\n" + read(folder + "/redmap.glsl") + kFragment);
  glLinkProgram(program), glUseProgram(program);
  char log[4096] = "";
  glGetProgramInfoLog(program, sizeof log, nullptr, log);
  if (*log) return fprintf(stderr, "%s\n", log), 1;
  // Weights: all levels, as they are in the file. Words: nearest.
  GLuint textures[2], buffers[2], target, depth, frame, vertices;
  glGenTextures(2, textures), glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const std::string weights = read(folder + "/weights.bin"), words = read(folder + "/words.bin");
  glBindTexture(GL_TEXTURE_2D_ARRAY, textures[0]);
  for (std::size_t level = 0, at = 0; level < std::size_t(levels); ++level) {
    const int w = std::max(1, width >> level), h = std::max(1, height >> level);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, GLint(level), GL_RGBA8, w, h, layers, 0, GL_RGBA, GL_UNSIGNED_BYTE, &weights[at]);
    at += std::size_t(w) * h * layers * 4;
  }
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, number(4) ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glActiveTexture(GL_TEXTURE1), glBindTexture(GL_TEXTURE_2D, textures[1]);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, 2048, number(5), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, words.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glUniform1i(glGetUniformLocation(program, "redmap_words"), 1);
  glUniform1f(glGetUniformLocation(program, "distance_"), std::stof(arguments[10]));
  // The mesh: 12 floats a vertex, then the indices.
  const std::string mesh = read(folder + "/mesh.bin");
  glGenVertexArrays(1, &vertices), glBindVertexArray(vertices), glGenBuffers(2, buffers);
  glBindBuffer(GL_ARRAY_BUFFER, buffers[0]), glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[0]);
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.size()), mesh.data(), GL_STATIC_DRAW);
  for (GLuint i = 0; i < 5; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i,
                          i < 3    ? 3
                          : i == 3 ? 2
                                   : 1,
                          GL_FLOAT, GL_FALSE, 48, reinterpret_cast<void*>(i < 4 ? 12ull * i : 44ull));
  }
  glGenFramebuffers(1, &frame), glBindFramebuffer(GL_FRAMEBUFFER, frame), glGenRenderbuffers(1, &target);
  glBindRenderbuffer(GL_RENDERBUFFER, target), glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, pixels, pixels);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  glGenRenderbuffers(1, &depth), glBindRenderbuffer(GL_RENDERBUFFER, depth);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, pixels, pixels);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  glViewport(0, 0, pixels, pixels), glEnable(GL_DEPTH_TEST), glClearColor(-1, -1, -1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, number(7), GL_UNSIGNED_INT, reinterpret_cast<void*>(48ull * number(6)));
  std::vector<float> picture(std::size_t(pixels) * pixels * 3);
  glReadPixels(0, 0, pixels, pixels, GL_RGB, GL_FLOAT, picture.data());
  std::ofstream out(arguments[12], std::ios::binary);
  out << "PF\n" << pixels << " " << pixels << "\n-1.0\n";
  out.write(reinterpret_cast<const char*>(picture.data()), std::streamsize(picture.size() * sizeof(float)));
  return glGetError() != GL_NO_ERROR || !out;
}
