# The folders of src/, floor by floor from the ground: a file includes files of its own folder and of the floors below.
# Folders of one floor do not include each other. scripts/include-graph reads this list, too.
set(FLOORS "CORE" "HOST" "PAIR ATOM" "FIX RUN" "COMPUTE" "COMMAND")

string(REPLACE " " ";" SOURCE_FOLDERS "${FLOORS}")
list(TRANSFORM SOURCE_FOLDERS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/src/")
set(STYLE_FOLDERS ${SOURCE_FOLDERS})  # all but the kernels
list(POP_FRONT STYLE_FOLDERS)
