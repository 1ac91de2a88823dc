#!/bin/sh
# Makes a course of lessons of about 30 s, each with other words, spoken by espeak-ng (Debian: espeak-ng).
#
#     tests/farm/course.sh FOLDER [LESSONS]
#
# The face is that of projects/nihao. LIANPU names the program where it is not on the PATH.
set -eu
folder=${1:?usage: course.sh FOLDER [LESSONS]} lessons=${2:-100}
program=${LIANPU:-lianpu}
here=$(cd "$(dirname "$0")/../.." && pwd)

sentence() {
    case $(($1 % 10)) in
        0) echo '您好，我是您的中文老师。|nin2 hao3, wo3 shi4 nin2 de5 zhong1 wen2 lao3 shi1.' ;;
        1) echo '今天我们学习说话的口形。|jin1 tian1 wo3 men5 xue2 xi2 shuo1 hua4 de5 kou3 xing2.' ;;
        2) echo '请看我的嘴，跟我一起说。|qing3 kan4 wo3 de5 zui3, gen1 wo3 yi4 qi3 shuo1.' ;;
        3) echo '她高兴的时候，眼睛也在笑。|ta1 gao1 xing4 de5 shi2 hou5, yan3 jing1 ye3 zai4 xiao4.' ;;
        4) echo '他昨天很生气，今天已经好了。|ta1 zuo2 tian1 hen3 sheng1 qi4, jin1 tian1 yi3 jing1 hao3 le5.' ;;
        5) echo '明天下午三点我们去图书馆。|ming2 tian1 xia4 wu3 san1 dian3 wo3 men5 qu4 tu2 shu1 guan3.' ;;
        6) echo '北京的秋天非常美丽。|bei3 jing1 de5 qiu1 tian1 fei1 chang2 mei3 li4.' ;;
        7) echo '请问，火车站在什么地方？|qing3 wen4, huo3 che1 zhan4 zai4 shen2 me5 di4 fang1?' ;;
        8) echo '我想喝一杯热茶，谢谢您。|wo3 xiang3 he1 yi4 bei1 re4 cha2, xie4 xie5 nin2.' ;;
        9) echo '再见，我们下个星期见。|zai4 jian4, wo3 men5 xia4 ge5 xing1 qi1 jian4.' ;;
    esac
}

mkdir -p "$folder"
lesson=1
while [ "$lesson" -le "$lessons" ]; do
    one=$folder/$(printf 'lesson-%03d' "$lesson")
    rm -rf "$one"
    cp -R "$here/projects/nihao" "$one"
    clip=$one/clips/nihao
    rm -rf "$one/export" "$one/.lianpu" "$clip/timing.TextGrid" "$clip/score.toml"
    # Ten sentences, in an order of this lesson's own.
    step=$((1 + 2 * (lesson % 2) + 6 * (lesson % 3 / 2))) i=0
    while [ $i -lt 10 ]; do
        sentence $((lesson + i * step))
        i=$((i + 1))
    done >"$one/both.txt"
    cut -d '|' -f 1 "$one/both.txt" >"$clip/script.txt"
    cut -d '|' -f 2 "$one/both.txt" | espeak-ng -v cmn-latn-pinyin -s 190 -w "$clip/speech.wav"
    rm "$one/both.txt"
    "$program" align "$one" >/dev/null
    lesson=$((lesson + 1))
done
