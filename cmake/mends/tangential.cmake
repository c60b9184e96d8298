# Tangential damping that may exceed the friction limit.

function(mend_damping name limit indent)
  set(file tangential_model_${name}.h)
  set(old "")
  set(new "\n${indent}const double spring[3] = {Ft1, Ft2, Ft3}, u[3] = {sidata.vtr1, sidata.vtr2, sidata.vtr3};
${indent}const double acting = grainscope::TangentialBound::get().damping(gammat, spring, u, ${limit});")
  foreach(k 1 2 3)
    string(APPEND old "\n${indent}Ft${k} -= (gammat*sidata.vtr${k});")
    string(APPEND new "\n${indent}Ft${k} -= (acting*sidata.vtr${k});")
  endforeach()
  mend(${file} "${old}" "${new}"
       "tangential damping beyond the friction limit in the first evaluation of a run: noted, or kept to it, as pair_style gran/insitu asks")
  mend(${file} "P_diss_local = gammat*" "P_diss_local = acting*" "likewise, in its heat")
  mend(${file} "\n#include \"tangential_model_base.h\"" "\n#include \"tangential_model_base.h\"\n#include \"tangential_bound.h\"" "likewise")
  set(MENDED_FILES ${MENDED_FILES} PARENT_SCOPE)
  set(HOST_MENDS ${HOST_MENDS} PARENT_SCOPE)
endfunction()

mend_damping(history Ft_friction "          ")
mend_damping(luding_tn Ft_frictionS "        ")
