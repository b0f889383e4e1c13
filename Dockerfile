# One image for the server and for the simulated unit; docker-compose.yml starts both.
FROM node:20-bookworm
RUN apt-get update \
 && apt-get install -y --no-install-recommends make gcc libc6-dev python3 python3-dev python3-venv \
 && rm -rf /var/lib/apt/lists/*
WORKDIR /spindle
COPY . .
RUN make setup && useradd --create-home rider && mkdir -p /data && chown rider /data
USER rider
ENV SPINDLE_DATA=/data
ENTRYPOINT [".venv/bin/spindle"]
CMD ["serve"]
