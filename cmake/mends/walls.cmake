# Walls that push where they should not, or do not report where they push.

# A rotating cylinder: its velocity is that of the contact point.
mend(fix_wall_gran.cpp "primitiveWall_->calcRadialDistance(x_[iPart],rdist);" "double at_wall[3];
          vectorAdd3D(x_[iPart],delta,at_wall);
          primitiveWall_->calcRadialDistance(sidata.is_non_spherical ? sidata.contact_point : at_wall,rdist);"
     "a rotating primitive cylinder has the velocity of the grain's centre, not of the contact point")
mend(primitive_wall_definitions.h "return Cylinder<1>::calcRadialDistance(pos,param,dx,dz);"
     "return Cylinder<1>::calcRadialDistance(pos,param,dz,dx);" "a rotating ycylinder has a velocity along its radius")

# A superquadric on a mesh: where its lowest point lies beside a triangle, the neighbour in the same plane has the
# contact.
mend(tri_mesh_I_superquadric.h "        if(dFace < 0.001*particle.shape[0] or flag == 0) {" "        if(flag > 0) {
          int beyond[3], n_beyond = 0;
          for(int k = 0; k < 3; k++)
            if(baryFace[k] < 0.0) beyond[n_beyond++] = k;
          const bool active = n_beyond == 0 or (n_beyond == 1 and edgeActive(nTri)[(beyond[0]+1)%3]) or
                              (n_beyond == 2 and cornerActive(nTri)[3-beyond[0]-beyond[1]]);
          if(!active) return LARGE_TRIMESH;
        }
        if(dFace < 0.001*particle.shape[0] or flag == 0) {"
     "a superquadric near an edge is pushed by every triangle of the plane, not by one")
set(resolve "deltan = mesh->resolveTriSuperquadricContact(iTri, delta, sidata.contact_point, particle, bary);")
mend(fix_wall_gran.cpp "                    ${resolve}"
     "                    ${resolve}
                    double face_normal[3];
                    mesh->surfaceNorm(iTri, face_normal);
                    barysign = deltan <= 0 && fabs(vectorDot3D(delta, face_normal)) > 1. - 1e-12 ? 7 : -1;"
     "a superquadric on an edge likewise, and its spring is lost from one triangle of a plane to the next")

# The lever of a superquadric on a wall.
mend(fix_wall_gran_base.h "            delta[2] = -sidata.delta[2];\n" "            delta[2] = -sidata.delta[2];
            if(atom->superquadric_flag) vectorSubtract3D(sidata.contact_point,x,delta);\n"
     "torque on a mesh and its wear assume the contact point of a superquadric one unit of length from its centre")
set(add "wg->add_contactforce_stress_wall(ip, i_forces,")
mend(fix_wall_gran_base.h "      ${add} sidata.delta, vwall, mesh?mesh->id(iTri):0);"
     "    {
      double branch[3];
      vectorSubtract3D(x,sidata.contact_point,branch);
      ${add} atom->superquadric_flag ? branch : sidata.delta, vwall,
                                       mesh?mesh->id(iTri):0);
    }"
     "the stress of wall contacts likewise")

mend(mesh_module_stress.h "virtual void setup(int vflag) {}"
     "virtual void setup(int vflag) {}\n    virtual void setup_pre_force(int vflag) { pre_force(vflag); }"
     "force and torque on a mesh are doubled when a run begins after another")

# A fix that is defined again under its ID is not in the list while the new one is made, which counts the fixes of its
# kind.
foreach(compare strncmp strcmp)
  mend(modify_liggghts.cpp "if(${compare}(fix[ifix]->style,style" "if(fix[ifix] && ${compare}(fix[ifix]->style,style"
       "a fix wall/gran that is defined again ends the program with a segmentation fault")
endforeach()

# A sphere just above an edge between two triangles of a plane: which triangle comes first may depend on the ranks.
mend(fix_contact_history_mesh_I.h "    if(haveContact(iP,idTri,history,intersect))
      return true;" "    if(faceflag && npartner_[iP] > 1 && coplanarContactAlready(iP,idTri))
      return false;
    if(haveContact(iP,idTri,history,intersect))
      return true;"
     "a sphere on an edge between two triangles of a plane is pushed by both after the ranks have exchanged them")
mend(fix_contact_history_mesh_I.h "if(idPartnerTri >= 0 && idPartnerTri != idTri && mesh_->map(idPartnerTri, 0) >= 0"
     "if(idPartnerTri >= 0 && keepflag_[iP][i] && idPartnerTri != idTri && mesh_->map(idPartnerTri, 0) >= 0" "likewise")
