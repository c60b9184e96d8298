# The same results, sooner: grains of blockiness 2 2 at walls. The tests unit-wall_searches compare the routines, bit for
# bit, with those of LIGGGHTS.

mend(superquadric.h "#include \"math_extra.h\"\n" "#include \"math_extra.h\"\n#include \"quick_wall_tests.h\"\n"
     "what a triangle does not touch is searched for contacts (next three)")
set(ellipsoid "blockiness[0] == 2.0 && blockiness[1] == 2.0")
mend(superquadric.cpp "double Superquadric::shape_function_local(const double *input_coord)
{" "double Superquadric::shape_function_local(const double *input_coord)
{
  if(${ellipsoid}) {
    const double p = input_coord[0]*shape_inv[0], q = input_coord[1]*shape_inv[1], r = input_coord[2]*shape_inv[2];
    return p*p + q*q + r*r - 1.0;
  }"
     "the shape function of an ellipsoid takes its powers from a table")
set(search "  double f1 = shape_function_local(closestPointLocal1);
  double f2 = shape_function_local(closestPointLocal2);
  if(f1 < 0.0 or f2 < 0.0)
    return true;
  else {")
mend(superquadric.cpp "${search}" "  if(${ellipsoid} && grainscope::misses_line(A, B, shape_inv)) return false;
${search}"
     "edges of triangles are searched that an ellipsoid does not reach")
mend(tri_mesh_I_superquadric.h "    double pointOfMaximalPenetration[3], pointOfLowestPotential[3];
" "    const bool ellipsoid = particle.blockiness[0] == 2.0 && particle.blockiness[1] == 2.0;
    if(ellipsoid && grainscope::misses_plane(surfNorm, n[0], particle.center, particle.rotation_matrix, particle.shape))
      return LARGE_TRIMESH;
    double pointOfMaximalPenetration[3], pointOfLowestPotential[3];
"
     "so are planes")
mend(tri_mesh_I_superquadric.h "    else {
      double **n = node_(nTri);
" "    else {
      double **n = node_(nTri);
      if(particle.blockiness[0] == 2.0 && particle.blockiness[1] == 2.0 &&
         grainscope::misses_edges(n, particle.center, particle.rotation_matrix, particle.shape_inv))
        return -1;
"
     "and all edges of a triangle")
set(grain "                  Superquadric particle(x_[iPart], quat_[iPart], shape_[iPart], blockiness_[iPart]);\n\n")
set(near "                  if(mesh->sphereTriangleIntersection(iTri, radius_[iPart], x_[iPart])) \
//check for Bounding Sphere-triangle intersection
                  {
")
mend(fix_wall_gran.cpp "${grain}${near}" "${near}${grain}" "a superquadric is made for every triangle of its neighbours")
set(powers "  else
  {
    double n = floor(fabs(exponent));")
mend(math_extra_liggghts_nonspherical.h "${powers}" "  else if(exponent == 1.0)
    return base;
  else if(exponent == 2.0)
    return base*base;
${powers}" "the first and second powers are found by their exponents")
