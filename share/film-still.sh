#!/usr/bin/env bash
# A frame of a film as a picture; README's is one of the demo's (needs python3-opencv).
#   share/film-still.sh [film] [frame] [picture]     default: out/demo/film.mp4 41 share/pictures/virtual_scan.jpg
set -euo pipefail
cd "$(dirname "$0")/.."
python3 - "${1:-out/demo/film.mp4}" "${2:-41}" "${3:-share/pictures/virtual_scan.jpg}" <<'END'
import sys
import cv2

film, frame, picture = sys.argv[1], int(sys.argv[2]), sys.argv[3]
video = cv2.VideoCapture(film)
video.set(cv2.CAP_PROP_POS_FRAMES, frame)
found, still = video.read()
if not found:
    sys.exit(f"film-still: {film} has no frame {frame}")
cv2.imwrite(picture, still, [cv2.IMWRITE_JPEG_QUALITY, 88])
END
