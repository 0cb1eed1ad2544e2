#!/usr/bin/env bash
# Runs one fuzz target on seeds from the repository: fuzz/run.sh TARGET [SECONDS [BUILD]]. Build it first, or use ./lapwing fuzz.
#
# What the fuzzer finds interesting stays in build/fuzz/corpus/TARGET for the next run; an input that fails is written to
# build/fuzz/failures. At most one CPU and 2 GiB.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
target=${1:?usage: fuzz/run.sh TARGET [SECONDS [BUILD]]}
seconds=${2:-60}
bin=${3:-$root/build/fuzz}/fuzz
corpus=$root/build/fuzz/corpus/$target
seeds=$root/build/fuzz/seeds/$target
failures=$root/build/fuzz/failures
mkdir -p "$corpus" "$failures"
rm -rf "$seeds" && mkdir -p "$seeds"

# seed NAME: standard input as one seed.
seed() { cat >"$seeds/$1"; }

options=(-max_len=4096)
case $target in
  check | parse | run)
    for script in "$root"/examples/*.dolphin "$root"/tests/conformance/*.dolphin "$root"/tests/golden/check/*.dolphin; do
      cp "$script" "$seeds/$(basename "$(dirname "$script")")-$(basename "$script")"
    done
    options=(-max_len=8192 "-dict=$root/fuzz/dictionaries/dolphin.dict")
    ;;
  decode | fleet | frame | tlog) "$bin/frame_seeds" "$target" "$seeds" ;;
  bag)
    python3 "$root/fuzz/scans/bag_seeds.py" "$seeds"
    options=(-max_len=16384)
    ;;
  slam_state)
    python3 "$root/fuzz/scans/state_seeds.py" "$seeds"
    options=(-max_len=16384)
    ;;
  bus)
    # The first byte says which message; then CDR's head, little endian, and what reads as empty lists and zeros.
    for kind in 0 1 2 3 4 5 6 7 8 9 10 11 12 13; do
      { printf "\\x$(printf %02x "$kind")\x00\x01\x00\x00"; head -c 400 /dev/zero; } | seed "kind-$kind"
    done
    ;;
  building)
    cp "$root"/examples/buildings/*.toml "$seeds"
    printf '[[wall]]\nline=[[0,0],[4,0],[4,3],[0,3]]\nclosed=true\n[[door]]\nhinge=[1,0]\nlatch=[2,0]\nsign="7\\nWC"\nopen_s=1\nclosed_s=1\n[[person]]\nat=[3,1]\nwalks=true\n[[start]]\nat=[1,1]\n' | seed small
    ;;
  pictures)
    printf '\377HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=p\r\n\r\n--p\r\nContent-Length: 3\r\nX-Timestamp: 1700000000.25\r\n\r\nabc\r\n--p\r\n' | seed one
    printf '\004HTTP/1.1 404 Not Found\r\n\r\n' | seed refused
    ;;
  whep)
    # An offer as a browser makes it, of sound and video; and an answer of a drone.
    key='B6:F7:59:92:43:1D:62:97:AC:B5:89:42:16:EC:38:C8:38:9B:7C:0F:64:AD:E7:9B:FE:37:61:56:12:E0:5C:2A'
    { printf '\007v=0\r\no=- 1 2 IN IP4 127.0.0.1\r\ns=-\r\nt=0 0\r\nm=audio 9 UDP/TLS/RTP/SAVPF 111\r\na=mid:1\r\n'
      printf 'm=video 9 UDP/TLS/RTP/SAVPF 96 108\r\na=ice-ufrag:79Q+\r\na=ice-pwd:CZz2g9XhzBH7opNBXFIqGD0e\r\na=fingerprint:sha-256 %s\r\n' "$key"
      printf 'a=mid:0\r\na=recvonly\r\na=candidate:1 1 udp 1 192.0.2.7 5 typ host\r\na=rtpmap:108 H264/90000\r\n'
      printf 'a=fmtp:108 level-asymmetry-allowed=1;packetization-mode=1;profile-level-id=42e01f\r\n'; } | seed offer
    printf '\003HTTP/1.1 201 Created\r\nContent-Type: application/sdp\r\nLocation: /api/v1/whep/sessions/1\r\nContent-Length: 5\r\n\r\nv=0\r\n' | seed answer
    ;;
  car_park)
    cp "$root"/examples/car-park/*.toml "$seeds"
    printf 'anchor=[41,-8,90]\n[cars]\nstay_min=5\n[[area]]\ncorners=[[-9,-9],[9,-9],[9,9]]\n[[row]]\nat=[0,0]\ncount=3\nslant_deg=20\n[[car]]\nat=[1,1]\n[[lane]]\npoints=[[0,0],[9,0]]\n[[tree]]\nat=[5,5]\n[[building]]\ncorners=[[-9,5],[-5,5],[-5,9]]\n' | seed small
    printf 'file,time,east_m,north_m,up_m,yaw_deg,tilt_deg,roll_deg\na.png,2026-11-21T10:00:00Z,1,2,30,0,0,0\nb.png,2026-11-21T10:00:01Z,,,,,,\n' | seed poses
    options=(-max_len=8192)
    ;;
  look)
    printf '\004{"look":"signs","width":2,"height":1,"bytes":6}\nrgbrgb{"look":"signs","bytes":3}\njpg' | seed requests
    printf '\040{"look":"shot","source":"/dev/video0","wanted_width":960,"wanted_height":720}\n{"width":2,"height":1,"bytes":6}\nrgbrgb' | seed shot
    printf '\377{"signs":[{"box":[1,2,3,4],"score":0.5,"text":"221","kind":"office","crop_bytes":4}],"is_sharp":true,"bytes":4}\ncrop{"error":"it is black"}\n{"width":9,"height":9,"jpeg_bytes":3,"bytes":5}\nallsm' | seed answers
    ;;
  overlook)
    where='"world":"a.toml","at":"2026-01-01T00:00:00Z","anchor":[41,-8,90]'
    printf '{"look":"car park",%s,"width":96,"height":72,"view_rad":1.0,"pose":[1,2,30,0.5]}\n' "$where" | seed look
    printf '{"look":"car park'"'"'s truth",%s}\n' "$where" | seed question
    outline='"outline":[[0,0],[2.5,0],[2.5,5],[0,5]]'
    printf '{"slots":[{%s,"surety":0.9,"taken":0.1}],"cars":[{%s,"chance":0.8}]}\n' "$outline" "$outline" | seed sight
    printf '{"anchor":[41,-8,90],"ground_m":0,"slots":[{%s,"is_taken":true}]}\n' "$outline" | seed truth
    ;;
  survey_memory)
    outline='0,0,2.5,0,2.5,5,0,5'
    anchor='{"lat_deg":43.2585,"lon_deg":-79.9201,"alt_m":100}'
    printf '{"format":"lapwing survey","version":1,"at":"2026-01-01T00:00:00Z","anchor":%s,"lives":2,"begun":"2026-01-01T00:00:00Z","explores":true,"ending":"","pictures":3}\n%s\n{"at":"2026-01-01T00:00:00Z","vehicle":"d","lens":[64,48,60,60,32,24,0,0,0,0,0],"camera":[0,0,10,0,1,0,0],"ground":[0],"slots":[[%s,0.9],[%s,0.9,0.5]],"cars":[[%s,0.5]]}\n' \
      "$anchor" '{"type":"FeatureCollection","features":[{"type":"Feature","id":"slot-1","geometry":{"type":"Polygon","coordinates":[[[-79.9201,43.2585],[-79.92007,43.2585],[-79.92007,43.25855],[-79.9201,43.2585]]]},"properties":{"writer":"d","at":"2026-01-01T00:00:00Z","state":"free"}}]}' \
      "$outline" "$outline" "$outline" | seed memory
    ;;
  floor_plan)
    printf 'P2\n# a room\n9 9 1\n%s' "$(for y in 0 1 1 1 1 1 1 1 0; do for x in 0 1 1 1 1 1 1 1 0; do printf '%d ' $((x * y)); done; done)" | seed plain
    printf 'P5\n3 2\n255\n\000\376\376\000\376\315' | seed binary
    printf 'P5\n1 1\n65535\n\377\377' | seed deep
    ;;
  url)
    i=0
    for url in udpin://0.0.0.0:14550 udpout://127.0.0.1:14550 tcpin://0.0.0.0:5760 tcpout://host:5760 serial:///dev/ttyUSB0:57600 \
      udp://:14550 'tcpout://[::1]:5760'; do
      printf '%s' "$url" | seed "url$((i += 1))"
    done
    options=(-max_len=256)
    ;;
  scan_log)
    printf 'PARAM robot_frontlaser_offset 0.1\nFLASER 3 1 2 3 0 0 0 0 0 0 1.5 h 1.5\n' | seed flaser
    printf 'ROBOTLASER1 0 -1.5 3.0 0.5 50 0.01 0 2 1 2 0 0 0 0 0 0 0 0 0 0 0 0 7.5 h 7.5\n' | seed robot_laser
    printf 'VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n' | seed g2o
    printf '1.5 2.5 1 2 0 0 0 0.5\n' | seed relations
    ;;
  client_request)
    printf '{"type":"ping","id":"1"}' | seed ping
    printf '{"type":"stop_script","id":"2"}' | seed stop
    printf '{"type":"subscribe","id":"3","feeds":["vehicles","log"],"run":"5d1c","revisions":{"log":88}}' | seed subscribe
    printf '{"type":"start_script","id":"3","name":"a.dolphin","source":"message \\"\\u00e9\\ud83d\\ude00\\""}' | seed start
    printf '{"type":"command","id":"4","vehicles":["1"],"action":"go_to","lat_deg":41,"lon_deg":-8,"height_m":20,"mode":"","take_over":true,"allow":{"too_far":"area B"},"operator":"anna"}' | seed command
    printf '{"type":"emergency_stop","action":"land"}' | seed emergency
    printf '{"type":"keep_control","vehicle":"3"}' | seed keep
    printf '{"type":"acknowledge_alarms","numbers":[3,5]}' | seed alarms
    ;;
  http)
    printf 'GET\n/\nHost: 127.0.0.1:8080\n' | seed page
    printf 'GET\n/assets/%%61pp.js?v=1\nHost: localhost\nIf-None-Match: "1"\n' | seed file
    printf 'GET\n/%%2e%%2e/secret.txt\nHost: [::1]:8080\n' | seed outside
    printf 'GET\n/api/v1/log?after=12&token=a%%20b\nHost: station.example\nAuthorization: Bearer token\n' | seed log
    printf 'POST\n/api/v1/script\nHost: localhost\nOrigin: http://localhost:8080\nContent-Type: application/json\n' | seed post
    ;;
  map_request)
    door='{"type":"Feature","geometry":{"type":"Point","coordinates":[179.9999,41]},"properties":{"kind":"door","at":"2026-01-01T00:00:00Z"}}'
    printf 'GET\n/ogc/collections/slots/items?bbox=179,40,-179,42&datetime=2026-01-01T00:00:00Z/..&limit=1&offset=0&state=free' | seed items
    printf 'GET\n/api/v1/layers/points_of_interest/features/north%%2F1' | seed feature
    printf 'GET\n/ogc/collections/grid:yard:0:floor/map/tiles/WebMercatorQuad' | seed tileset
    printf 'GET\n/api/v1/grids/yard/0/floor/tiles/18/262143/98300.png?revision=a-1' | seed picture
    printf 'PUT\n/api/v1/layers/points_of_interest/features/d?floor=1&writer=me\n%s' "$door" | seed put
    printf 'POST\n/api/v1/layers/points_of_interest/features\n{"type":"FeatureCollection","features":[%s]}' "$door" | seed post
    printf 'PUT\n/api/v1/sites/office\n{"anchor":{"lat_deg":1,"lon_deg":2,"alt_m":3},"floors":[{"id":"0","name":"G","up_m":1,"x_m":2,"y_m":3,"yaw_rad":4}]}' | seed site
    printf 'POST\n/api/v1/blobs\n\211PNG' | seed blob
    ;;
  features)
    # Its first letter says which layer: the six in turn, beginning with a letter that six divides, f.
    feature='{"type":"Feature","id":"1","geometry":{"type":"%s","coordinates":%s},"properties":{"at":"2026-01-01T00:00:00Z",%s}}'
    ring='[[[179.999,41],[-179.999,41],[180,41.001],[179.999,41]]]'
    line='[[179.999,41],[180.0001,41]]'
    printf "f$feature" Polygon "$ring" '"state":"taken","seen_at":"2025-12-31T23:00:00+01:00","taken_probability":0.5,"held_over":[{"property":"name","writer":"a","at":"2025-01-01T00:00:00Z"}]' | seed slots
    printf "g$feature" LineString "$line" '"height_m":3' | seed walls
    printf "h$feature" Point '[179.999,41]' '"kind":"door","covariance_xx_m2":1,"covariance_xy_m2":0,"covariance_yy_m2":1' | seed points_of_interest
    printf "i$feature" Polygon '[[[180,41],[180.0001,41],[180.0001,41.0001],[180,41.0001],[180,41]]]' '"image":"'"$(printf '%064d' 0)"'","taken_at":"2025-01-01T00:00:00Z","camera_x_m":1,"camera_qw":1,"camera_qx":0,"camera_qy":0,"camera_qz":0' | seed pictures
    printf "j$feature" LineString "$line" '"began_at":"2025-12-31T00:00:00Z","times_s":"0 1.5","ups_m":"3 4"' | seed tracks
    printf 'k{"type":"FeatureCollection","features":['"$feature"']}' MultiPolygon "[$ring]" '"purpose":"no_go","lowest_m":1,"highest_m":2,"floor":null' | seed areas
    ;;
  geojson)
    cp "$root"/examples/*.geojson "$seeds"
    printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"keep":"out"},"geometry":{"type":"MultiPolygon","coordinates":[[[[-8,41],[-7.9,41],[-8,41.1],[-8,41]]]]}}]}' |
      seed collection
    ;;
  pmtiles)
    # A header, a root of one tile and one leaf, and bytes for both, all unpacked: PMTiles 3.
    { printf 'PMTiles\3'
      for number in 127 12 139 2 141 6 147 8 1 1 1; do printf "\\x$(printf %02x "$number")\0\0\0\0\0\0\0"; done
      printf '\1\1\1\2\0\5'; head -c 25 /dev/zero
      printf '\2\0\1\1\0\4\6\1\1\0\0\0{}\1\1\1\4\5\0zerofive'; } | seed archive
    ;;
  jpeg)
    # Grey, eight pixels a side: all that a decoder wants.
    python3 "$root/fuzz/video/jpeg_seed.py" | seed grey
    ;;
  picture)
    # A grey PNG of one pixel, and the beginnings of a JPEG with EXIF and of a WebP.
    { printf '\211PNG\r\n\032\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\10\0\0\0\0:~\233U\0\0\0\nIDATx\234c`\0\0\0\2\0\1H\257\244q\0\0\0\0IEND\256B`\202'; } | seed png
    printf '\377\330\377\341\0\"Exif\0\0II*\0\10\0\0\0\1\0\22\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0\377\300\0\13\10\0\10\0\10\1\1\21\0\377\332\0\10\1\1\0\0?\0\377\331' | seed jpeg
    printf 'RIFF\32\0\0\0WEBPVP8L\r\0\0\0/\0\0\0\20\7\20\21\21\210\210\376\7\0' | seed webp
    ;;
  operator_link)
    printf '\017LW\1\7\10\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0' | seed frame
    printf '\1\4\35\1\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\3keytext\5\11\0\2\0\0\0\0\0\0\0\11\4\2\0ok' | seed messages
    printf '\15{"Type":"Autonomous Move","X":1,"Y":[2,{"a":"\\"}"}]}{}\r\n {"b":\n{"c":1}]x' | seed objects
    ;;
  journal)
    eight='%b\0\0\0\0\0\0\0'
    printf "\3\51\1$eight$eight$eight$eight$eight\14\2$eight\1kt\11\3$eight" '\7' '\1' '\1' '\5' '\2' '\1' '\1' | seed segment
    ;;
  drone_command)
    printf '{"Type":"Configure","Min":7,"Des":10.5,"MaxHoverHeight":20}' | seed configure
    printf '{"Type":"Autonomous Move","X":-3.5,"Y":4,"w":0.5}' | seed move
    printf '{"Type":"CompulsiveMove","Lat":43.001,"Long":-79}' | seed globe
    printf '{"Type":"Compulsive Move","X":1,"Y":2}{"Type":"Kill"}' | seed two
    printf '{"Type":"Map","Send":"Changes"}' | seed map-request
    { printf '{"Type":"Map","Revision":1,"Columns":3,"Rows":2,"Resolution":0.5,"Origin X":-1,"Origin Y":2,"Cells":[-1,0,100,50,7,-1]}\n'
      printf '{"Type":"Map Changes","Revision":2,"Since":1,"Changes":[[0,5,6],[4,-1]]}\n'
      printf '{"Type":"Map Changes","Revision":4,"Since":3,"Changes":[[5,9]]}\n'; } | seed map
    printf '# x\nmin_hover_height_m = 7\ndesired_hover_height_m = 10\nmax_hover_height_m = 20\n# crc32 = 00000000\n' | seed settings
    ;;
  robot_frames)
    printf '\6\1\26\5\334\2\0' | seed alive
    printf '\21\1\0\240\0\0\0\0\0\0' | seed drive
    { printf '\2'; head -c 8 /dev/zero; printf '\1\0\0\0\2\0\0\0\60\165'; head -c 24 /dev/zero; printf '\1\144\0\340\56\120\0\0\1\0\0\0\0\0\0\0'; } | seed readings
    { printf '\1'; head -c 8 /dev/zero; printf '\200\251\3\0\100\113\114\0\54\1\364\1\226\0\226\0\214\0\1\226\0\0\0\0\0\372\0\114\35'; head -c 22 /dev/zero; } | seed hello
    { printf '\3'; head -c 16 /dev/zero; printf '\4\0\2\0\2\1\0\2\0'; } | seed laser
    ;;
  seed_text)
    printf ' PLN_CAR_1_Medium\nPLN_CAR_2_90\nSIM_PLN_3_120:-:300\nMMU_CM_4_10-20-90\r\nPOI_CM_5_"Name Tag", "2%%5F21", 15, 20\nCC_CAR_6_e-Stop\nMMU_CC_7_ready:302:9\nCC_PLN_8_CONTINUE\n' | seed lines
    ;;
  key_store)
    printf '[keys]\nfleet = "%064d"\nnext = "%064d"\n[use]\neverybody = "fleet"\n[use.vehicles]\n7 = ["next", "fleet"]\n[use.links]\n"udpin://0.0.0.0:14550" = "next"\n[unsigned]\nlocal-links = true\nsystems = [51]\nmessages = ["ADSB_VEHICLE", 0]\n' 1 2 | seed store
    ;;
  kml)
    mark='<Placemark><name>a</name><ExtendedData><Data name="%s"><value>%s</value></Data></ExtendedData>%s</Placemark>'
    printf "$mark" role home '<Point><altitudeMode>absolute</altitudeMode><coordinates>-8,41,90</coordinates></Point>' | seed home
    printf "$mark" command 16 '<Point><coordinates>-8,41,30</coordinates></Point>' | seed item
    printf "$mark" radius_m 30 '<Point><coordinates>-8,41</coordinates></Point>' | seed circle
    printf "$mark" min_height_m 3 '<LineString><altitudeMode>relativeToGround</altitudeMode><coordinates>-8,41,9 -8,41.1,9</coordinates></LineString>' | seed path
    ring='<LinearRing><coordinates>-8,41 -7,41 -7,42 -8,41</coordinates></LinearRing>'
    printf "$mark" fence exclusion "<MultiGeometry><Polygon><outerBoundaryIs>$ring</outerBoundaryIs><innerBoundaryIs>$ring</innerBoundaryIs></Polygon></MultiGeometry>" | seed area
    printf '<?xml version="1.0"?><!DOCTYPE kml [<!ENTITY a "b">]><kml><Folder><name>rally &amp; &a;</name></Folder></kml>' | seed whole
    options=(-max_len=4096 "-dict=$root/fuzz/dictionaries/kml.dict")
    ;;
  waypoints)
    printf '0\t1\t0\t16\t0\t0\t0\t0\t41\t-8\t90\t1\n1\t0\t3\t22\t15\tnan\t0\t0\t41.1\t-8\t30\t1\n2\t0\t2\t177\t1\t-1\t0\t0\t0\t0\t0\t1\n' | seed mission
    printf '0 0 0 5001 3 0 0 0 41 -8 0 1\n1 0 0 5001 3 0 0 0 41 -7 0 1\n2 0 0 5001 3 0 0 0 42 -7 0 1\n3 0 0 5004 50 0 0 0 41 -7 0 1\n4 0 3 5000 0 0 0 0 41 -7 9 1\n' | seed fence
    printf '0 1 0 16 0 0 0 0 41 -8 9 1\n1 0 3 5100 0 0 0 0 41 -8 25 1\n' | seed rally
    ;;
  lsp)
    position='"textDocument":{"uri":"u"},"position":{"line":1,"character":16}'
    i=0
    for method in hover completion definition rename references documentSymbol formatting signatureHelp; do
      body='{"id":'$((i += 1))',"method":"textDocument/'$method'","params":{'$position',"newName":"x","options":{"tabSize":2}}}'
      printf 'Content-Length: %d\r\n\r\n%s' ${#body} "$body" | seed "$method"
    done
    body='{"method":"textDocument/didChange","params":{"textDocument":{"uri":"u","version":2},"contentChanges":[{"range":{"start":{"line":0,"character":0},"end":{"line":1,"character":3}},"text":"w"}]}}'
    printf 'Content-Length: %d\r\n\r\n%s' ${#body} "$body" | seed change
    ;;
  plan)
    items=$(printf '{"type":"SimpleItem","autoContinue":true,"command":%d,"doJumpId":1,"frame":3,"params":[0,0,0,null,41.2,-8.6,30]},' 22 16 82 178 177 20)
    printf '{"fileType":"Plan","version":1,"groundStation":"QGroundControl","mission":{"version":2,"plannedHomePosition":[41,-8,90],"items":[%s]},"geoFence":{"version":2},"rallyPoints":{"version":2}}' \
      "${items%,}" | seed simple
    printf 'QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t41\t-8\t90\t1\n1\t0\t3\t22\t15\t0\t0\t0\t41.1\t-8\t30\t1\n' | seed waypoints
    printf '{"fileType":"Plan","mission":{"items":[{"type":"ComplexItem","complexItemType":"survey","TransectStyleComplexItem":{"Items":[%s]}},{"type":"ComplexItem"}]},"geoFence":{"circles":[{"circle":{"center":[41,-8],"radius":9}}],"polygons":[{"inclusion":false,"polygon":[[1,2],[3,4],[5,7]]}],"breachReturn":[1,2,3]},"rallyPoints":{"points":[[1,2,3]]}}' \
      "${items%%,}" | seed whole
    printf '{"type":"FeatureCollection","cruise_speed_m_s":9,"features":[{"type":"Feature","geometry":{"type":"Point","coordinates":[-8,41,9]},"properties":{"command":16,"frame":3,"params":[0,null,0,0],"autocontinue":false}},{"type":"Feature","geometry":null,"properties":{"role":"pattern","first":1,"count":1,"source":{"type":"SimpleItem"}}},{"type":"Feature","geometry":{"type":"LineString","coordinates":[[-8,41,9],[-8,42]]},"properties":{}}]}' | seed geojson
    ;;
  parameter_file)
    printf '# Lapwing cache, taken (seconds since 1970): 5\n# Lapwing cache, hash: 00c0ffee\n1\t1\tRTL_ALT\t1500\t6\n1\t1\tA\t-1.5e-3\t9\n' | seed qgroundcontrol
    printf '#NOTE\nRTL_ALT,1500\nWPNAV_SPEED 1000 # cm/s\nSTAT_RESET,1,@READONLY\n' | seed mission_planner
    ;;
  route)
    # Settings, a zero, and pieces whose first byte says where each comes in and how long it is: 42 is 21 bytes on the first endpoint.
    beat='\xfd\x09\x00\x00\x07\xff\xbe\x00\x00\x00\x00\x00\x00\x00\x06\x08\x00\x04\x03\x7e\xfa'
    printf '[[endpoint]]\nurl="udpin://0.0.0.0:1"\nmessages_per_s=5\n[endpoint.in]\nblock_systems=[3]\n[[endpoint]]\nurl="udpout://1.1.1.1:1"\nsniffer=true\n\x00*%b+%b*%b' \
      "$beat" "$beat" "$beat" | seed limited
    printf '[[endpoint]]\nurl="serial:///dev/a:9600"\n[endpoint.out]\nallow_messages=["HEARTBEAT"]\n\x00*%b+%b' "$beat" "$beat" | seed serial
    ;;
  *)
    echo "fuzz/run.sh: there is no target $target" >&2
    exit 2
    ;;
esac

# Without a limit of its own the address sanitizer asks the system for whatever a length field says.
export ASAN_OPTIONS=allocator_may_return_null=0:max_allocation_size_mb=1024 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
symbolizer=$(command -v llvm-symbolizer-19 || command -v llvm-symbolizer || true)
[ -z "$symbolizer" ] || export ASAN_SYMBOLIZER_PATH=$symbolizer
exec "$bin/fuzz_$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 "${options[@]}" \
  -artifact_prefix="$failures/$target-" "$corpus" "$seeds"
