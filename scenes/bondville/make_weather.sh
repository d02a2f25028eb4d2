#!/bin/sh
# Makes weather.csv of this scene from the measurements of NOAA/ARL's flux site at Bondville, Illinois, in 1998 (T. Meyers),
# as NOAA's Noah land-surface model is tested with: test/forcing98_with_validation.dat of
# https://github.com/NOAA-EMC/NoahLSM. That file comes without a licence, so it is not here.
#
#     ./make_weather.sh forcing98_with_validation.dat [FIRST_DAY LAST_DAY] > weather.csv
#
# Days of the year count from 1; without them 1 to 15 July. Half hours, their stamps at the end, local standard time (UTC-6);
# what is below -6000 was not measured.
[ -r "$1" ] || { echo "usage: $0 forcing98_with_validation.dat [FIRST_DAY LAST_DAY] > weather.csv" >&2; exit 2; }
LC_ALL=C awk -v first="${2:-182}" -v last="${3:-196}" '
BEGIN {
    split("31 28 31 30 31 30 31 31 30 31 30 31", days)
    print "time,air_temperature,relative_humidity,pressure,wind_speed,rain,shortwave_down,longwave_down"
}
function cell(x) { return x < -6000 ? "" : x }
function none_below_zero(x) { return x < -6000 ? "" : x > 0 ? x : 0 }
NF >= 30 && $1 >= first && $1 <= last {
    day = $1; hour = int($2 / 100)
    if (hour == 24) { hour = 0; day++ }
    for (month = 1; day > days[month]; month++) day -= days[month]
    printf "1998-%02d-%02dT%02d:%02d:00-06:00,%s,%s,%s,%s,%s,%s,%s\n", month, day, hour, $2 % 100, cell($5), \
        cell($6 > 100 ? 100 : $6), cell($7), cell($3), none_below_zero($13), none_below_zero($8), cell($30)
}' "$1"
