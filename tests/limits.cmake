# Seconds, against hangs alone: ranks that wait for one another take up to 90 times as long beside six busy processes on
# two cores (measured), whether or not Open MPI yields, and the sanitizers twelve times.
# For each run of a test, and for each of one that is long; a test as a whole has three times as much.
set(TIME_LIMIT 3600)
set(LONG_TIME_LIMIT 36000)
if(GRAINSCOPE_SANITIZE)
  math(EXPR TIME_LIMIT "12 * ${TIME_LIMIT}")
  math(EXPR LONG_TIME_LIMIT "12 * ${LONG_TIME_LIMIT}")
endif()
math(EXPR TEST_TIMEOUT "3 * ${TIME_LIMIT}")
math(EXPR LONG_TEST_TIMEOUT "3 * ${LONG_TIME_LIMIT}")
