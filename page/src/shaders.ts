// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The shaders. Every part's pose and look are fetched by its number from two textures, so that moving, fading or hiding parts
// costs one small upload. Colours are written as they are to be shown.

const kParts = /* glsl */ `
  uniform highp sampler2D poses;
  uniform sampler2D looks;
  vec4 rowOf(int part, int row) {
    int width = textureSize(poses, 0).x;
    int j = 3 * part + row;
    return texelFetch(poses, ivec2(j % width, j / width), 0);
  }
  mat4 poseOf(int part) {
    return transpose(mat4(rowOf(part, 0), rowOf(part, 1), rowOf(part, 2), vec4(0.0, 0.0, 0.0, 1.0)));
  }
  vec4 lookOf(int part) {
    int width = textureSize(looks, 0).x;
    return texelFetch(looks, ivec2(part % width, part / width), 0);
  }
`;

const kSection = /* glsl */ `
  uniform vec4 section;  // what lies beyond the plane is cut away; no direction: no cut
  void cut(vec3 place) { if (dot(section.xyz, place) > section.w) discard; }
`;

/** Solid parts have a look of full alpha; fading ones are drawn in a pass of their own; hidden ones have alpha 0. */
export const partVertex = /* glsl */ `
  #include <batching_pars_vertex>
  ${kParts}
  uniform int recessed;
  uniform float isParallel;
  varying vec3 vNormal;
  varying vec3 vPlace;
  varying vec3 vView;
  flat varying vec4 vLook;
  flat varying float vTurn;
  flat varying int vPart;
  void main() {
    vPart = int(getIndirectIndex(gl_DrawID));
    vLook = lookOf(vPart);
    #ifdef GHOST
      bool isDrawn = vLook.a > 0.0 && vLook.a < 1.0;
    #else
      bool isDrawn = vLook.a == 1.0;
    #endif
    mat4 pose = poseOf(vPart);
    mat3 turn = mat3(pose);
    vTurn = determinant(turn) < 0.0 ? -1.0 : 1.0;
    // Right for stretched poses too: the cofactors of the matrix turn normals.
    mat3 cofactors = mat3(cross(turn[1], turn[2]), cross(turn[2], turn[0]), cross(turn[0], turn[1]));
    vNormal = mat3(viewMatrix) * (cofactors * normal.xyz);
    vec4 place = pose * vec4(position, 1.0);
    vPlace = place.xyz;
    vec4 seen = viewMatrix * place;
    vView = seen.xyz;
    // Away from the eye by more than rounding does to a face: of two faces in one place the other part's is seen.
    if (vPart == recessed) seen.xyz *= isParallel > 0.5 ? vec3(1.0, 1.0, 1.0003) : vec3(1.0003);
    gl_Position = isDrawn ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

export const partFragment = /* glsl */ `
  ${kSection}
  uniform vec3 backdrop;
  uniform float isParallel;
  varying vec3 vNormal;
  varying vec3 vPlace;
  varying vec3 vView;
  flat varying vec4 vLook;
  flat varying float vTurn;
  void main() {
    cut(vPlace);
    vec3 toEye = isParallel > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-vView);
    vec3 n = normalize(vNormal);
    if (dot(vNormal, vNormal) < 1e-30) n = toEye;
    bool isBack = gl_FrontFacing == (vTurn < 0.0);
    if (dot(n, toEye) < 0.0) n = -n;
    #ifdef GHOST
      // The same colour for all that fades would not depend on the order of drawing; the two shown parts nearly so.
      float rim = 1.0 - abs(dot(n, toEye));
      gl_FragColor = vec4(vLook.rgb, clamp(vLook.a * (0.4 + 1.9 * rim * rim * rim), 0.0, 0.9));
    #else
      if (isBack && dot(section.xyz, section.xyz) > 0.0) {
        // The inside of what is cut open: flat and hatched, as in a drawing.
        float stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 9.0);
        vec3 flatColour = mix(vLook.rgb, backdrop, 0.12) * 0.80;
        gl_FragColor = vec4(stripe < 1.6 ? flatColour * 0.72 : flatColour, 1.0);
        return;
      }
      float key = max(0.0, dot(n, normalize(vec3(-0.45, 0.65, 0.62))));
      float fill = max(0.0, dot(n, normalize(vec3(0.75, -0.1, 0.5))));
      float sky = 0.5 + 0.5 * n.y;
      float head = max(0.0, dot(n, toEye));
      float light = 0.46 + 0.14 * sky + 0.34 * key + 0.08 * fill + 0.10 * head;
      vec3 middle = normalize(toEye + normalize(vec3(-0.45, 0.65, 0.62)));
      float shine = 0.10 * pow(max(0.0, dot(n, middle)), 28.0);
      gl_FragColor = vec4(vLook.rgb * light + shine, 1.0);
    #endif
  }
`;

/** The number of the part, plus one, in three bytes. */
export const pickFragment = /* glsl */ `
  ${kSection}
  varying vec3 vPlace;
  flat varying int vPart;
  void main() {
    cut(vPlace);
    int id = vPart + 1;
    gl_FragColor = vec4(float(id & 255), float((id >> 8) & 255), float(id >> 16), 255.0) / 255.0;
  }
`;

export const edgeVertex = /* glsl */ `
  ${kParts}
  attribute float part;
  varying vec3 vPlace;
  flat varying vec4 vLook;
  void main() {
    int i = int(part);
    vLook = lookOf(i);
    vec4 place = poseOf(i) * vec4(position, 1.0);
    vPlace = place.xyz;
    bool isDrawn = vLook.a > 0.11;
    gl_Position = isDrawn ? projectionMatrix * viewMatrix * place : vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

export const edgeFragment = /* glsl */ `
  ${kSection}
  uniform vec3 ink;
  uniform float strength;
  varying vec3 vPlace;
  flat varying vec4 vLook;
  void main() {
    cut(vPlace);
    gl_FragColor = vec4(ink, strength * (vLook.a == 1.0 ? 1.0 : 0.55));
  }
`;

/** Lines of a width in pixels: each is a quad stretched from one end to the other on the screen. */
export const lineVertex = /* glsl */ `
  attribute vec3 from;
  attribute vec3 to;
  attribute vec3 tint;
  uniform vec2 size;
  uniform float width;
  varying vec3 vTint;
  void main() {
    vTint = tint;
    vec4 a = projectionMatrix * viewMatrix * vec4(from, 1.0);
    vec4 b = projectionMatrix * viewMatrix * vec4(to, 1.0);
    // An end behind the eye is pulled before it.
    float near = 1e-4 * max(abs(a.w), abs(b.w));
    if (a.w < near && b.w > near) a = mix(b, a, (b.w - near) / (b.w - a.w));
    if (b.w < near && a.w > near) b = mix(a, b, (a.w - near) / (a.w - b.w));
    vec2 p = a.xy / a.w * size;
    vec2 q = b.xy / b.w * size;
    vec2 along = q - p;
    along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec4 end = position.x < 0.5 ? a : b;
    vec2 shift = (across * position.y + along * (2.0 * position.x - 1.0)) * width;
    end.xy += shift / size * end.w;
    gl_Position = end;
  }
`;

export const lineFragment = /* glsl */ `
  uniform vec3 halo;
  uniform float isHalo;
  uniform float strength;
  varying vec3 vTint;
  void main() { gl_FragColor = vec4(isHalo > 0.5 ? halo : vTint, strength); }
`;
