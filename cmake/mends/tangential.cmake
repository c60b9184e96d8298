# Tangential damping that may exceed the friction limit: pair_style gran/insitu notes it, or limits it.

function(mend_damping name limit indent)
  set(file tangential_model_${name}.h)
  set(old "")
  set(new "\n${indent}const double spring[3] = {Ft1, Ft2, Ft3}, u[3] = {sidata.vtr1, sidata.vtr2, sidata.vtr3};
${indent}const double acting = grainscope::TangentialBound::get().damping(gammat, spring, u, ${limit});")
  foreach(k 1 2 3)
    string(APPEND old "\n${indent}Ft${k} -= (gammat*sidata.vtr${k});")
    string(APPEND new "\n${indent}Ft${k} -= (acting*sidata.vtr${k});")
  endforeach()
  mend(${file} "${old}" "${new}" "tangential damping exceeds the friction limit in the first evaluation of a run")
  mend(${file} "P_diss_local = gammat*" "P_diss_local = acting*" "heat of tangential damping likewise")
  set(include "\n#include \"tangential_model_base.h\"")
  mend(${file} "${include}" "${include}\n#include \"tangential_bound.h\"" "the header that limits tangential damping")
  set(MENDED_FILES ${MENDED_FILES} PARENT_SCOPE)
  set(HOST_MENDS ${HOST_MENDS} PARENT_SCOPE)
endfunction()

mend_damping(history Ft_friction "          ")
mend_damping(luding_tn Ft_frictionS "        ")
