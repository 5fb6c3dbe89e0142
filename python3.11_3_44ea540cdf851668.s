	.att_syntax
	.file	"3"
	.section	.lrodata.cst4,"aMl",@progbits,4
	.p2align	2, 0x0
.LCPI0_0:
	.long	0x40000000
.LCPI0_2:
	.long	0x7fffffff
.LCPI0_3:
	.long	0x3fc00000
.LCPI0_4:
	.long	0x37800000
.LCPI0_5:
	.long	0x35800000
.LCPI0_6:
	.long	0x35000000
.LCPI0_7:
	.long	1431655765
.LCPI0_8:
	.long	1
.LCPI0_9:
	.long	858993459
.LCPI0_10:
	.long	252645135
.LCPI0_12:
	.long	3
.LCPI0_13:
	.long	131070
.LCPI0_14:
	.long	0xbf800000
.LCPI0_15:
	.long	0x3f800000
.LCPI0_16:
	.long	31
.LCPI0_17:
	.long	3217031168
.LCPI0_18:
	.long	0x40100009
.LCPI0_19:
	.long	4278190080
.LCPI0_20:
	.long	0xff800000
.LCPI0_21:
	.long	0x7f800000
.LCPI0_22:
	.long	0x80000000
.LCPI0_23:
	.long	0x34000000
.LCPI0_24:
	.long	0x81800000
.LCPI0_25:
	.long	0x01800000
.LCPI0_26:
	.long	63
.LCPI0_27:
	.long	0x3f000000
.LCPI0_28:
	.long	2
.LCPI0_29:
	.long	32
.LCPI0_31:
	.long	16
.LCPI0_33:
	.long	4294967280
	.section	.rodata,"a",@progbits
	.p2align	6, 0x0
.LCPI0_1:
	.long	0
	.long	1
	.long	2
	.long	3
	.long	4
	.long	5
	.long	6
	.long	7
	.long	8
	.long	9
	.long	10
	.long	11
	.long	12
	.long	13
	.long	14
	.long	15
.LCPI0_11:
	.byte	0
	.byte	2
	.byte	128
	.byte	128
	.byte	4
	.byte	6
	.byte	128
	.byte	128
	.byte	8
	.byte	10
	.byte	128
	.byte	128
	.byte	12
	.byte	14
	.byte	128
	.byte	128
	.byte	16
	.byte	18
	.byte	128
	.byte	128
	.byte	20
	.byte	22
	.byte	128
	.byte	128
	.byte	24
	.byte	26
	.byte	128
	.byte	128
	.byte	28
	.byte	30
	.byte	128
	.byte	128
	.byte	32
	.byte	34
	.byte	128
	.byte	128
	.byte	36
	.byte	38
	.byte	128
	.byte	128
	.byte	40
	.byte	42
	.byte	128
	.byte	128
	.byte	44
	.byte	46
	.byte	128
	.byte	128
	.byte	48
	.byte	50
	.byte	128
	.byte	128
	.byte	52
	.byte	54
	.byte	128
	.byte	128
	.byte	56
	.byte	58
	.byte	128
	.byte	128
	.byte	60
	.byte	62
	.byte	128
	.byte	128
.LCPI0_30:
	.long	16
	.long	8
	.long	18
	.long	9
	.long	20
	.long	10
	.long	22
	.long	11
	.long	24
	.long	12
	.long	26
	.long	13
	.long	28
	.long	14
	.long	30
	.long	15
.LCPI0_32:
	.long	0
	.long	4294967295
	.long	4294967294
	.long	4294967293
	.long	4294967292
	.long	4294967291
	.long	4294967290
	.long	4294967289
	.long	4294967288
	.long	4294967287
	.long	4294967286
	.long	4294967285
	.long	4294967284
	.long	4294967283
	.long	4294967282
	.long	4294967281
	.section	.ltext,"axl",@progbits
	.globl	beams
	.prefalign	4, .Lfunc_end0, nop
	.type	beams,@function
beams:
	endbr64
	pushq	%rbp
	movq	%rsp, %rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	andq	$-64, %rsp
	subq	$4032, %rsp
	movq	24(%rdi), %r11
	movq	32(%rdi), %r8
	movl	40(%rdi), %edx
	movq	%rdi, %rax
	movq	(%rdi), %rcx
	movq	240(%rdi), %r15
	movl	56(%rax), %r14d
	movq	8(%rdi), %r9
	movq	16(%rdi), %r10
	movslq	48(%rax), %rbx
	movabsq	$.LCPI0_24, %r12
	movq	%r11, 136(%rsp)
	movq	%r8, 88(%rsp)
	movq	(%rsi), %r8
	movl	%edx, 124(%rsp)
	movq	248(%rdi), %rdx
	movq	8(%rsi), %r11
	movq	256(%rdi), %rdi
	movq	16(%rsi), %rsi
	movq	%rcx, 200(%rsp)
	movl	52(%rax), %ecx
	movl	%r14d, 76(%rsp)
	movl	60(%rax), %r14d
	movq	%rbx, 104(%rsp)
	movq	%r15, 208(%rsp)
	imulq	%r15, %r8
	imulq	%rdx, %r11
	addq	88(%rax), %r11
	imulq	%rdi, %rsi
	addq	96(%rax), %rsi
	addq	80(%rax), %r8
	movl	64(%rax), %eax
	movq	%rcx, 56(%rsp)
	movl	%r14d, 68(%rsp)
	movl	%eax, 116(%rsp)
	movq	%r15, %rax
	andq	$-16, %rax
	addq	%r11, %rdx
	movq	%r11, 168(%rsp)
	addq	%rsi, %rdi
	movq	%r8, 128(%rsp)
	movabsq	$.LCPI0_2, %r11
	movq	%rsi, 144(%rsp)
	addq	%r8, %rax
	movabsq	$.LCPI0_3, %r8
	movq	%rdx, 184(%rsp)
	movq	%rdi, 176(%rsp)
	movq	%rax, 192(%rsp)
	cmpq	$16, %r15
	jae	.LBB0_1
.LBB0_94:
	movq	208(%rsp), %rax
	movl	68(%rsp), %edi
	movq	88(%rsp), %rcx
	movq	56(%rsp), %rdx
	movabsq	$.LCPI0_22, %r12
	testb	$15, %al
	je	.LBB0_142
	movl	76(%rsp), %ebx
	vbroadcastss	(%r11), %xmm0
	addq	%rax, 128(%rsp)
	leal	(%rdx,%rdx), %eax
	movl	$1, %esi
	movabsq	$.LCPI0_0, %r14
	vmovss	(%r8), %xmm3
	vpbroadcastd	%edx, %zmm6
	vpxor	%xmm9, %xmm9, %xmm9
	shlxl	%eax, %esi, %eax
	vmovss	(%r14), %xmm1
	vpslld	$2, %zmm6, %zmm4
	movl	%eax, 1984(%rsp)
	subl	%edx, %ebx
	andl	$31, %ebx
	shlxl	%ebx, %esi, %eax
	movabsq	$.LCPI0_4, %rsi
	movl	%ebx, 1856(%rsp)
	leal	(,%rdx,4), %ebx
	movq	%rax, 896(%rsp)
	movq	104(%rsp), %rax
	vcvtsi2ss	%eax, %xmm15, %xmm2
	leaq	(,%rax,4), %rax
	movq	%rax, 1472(%rsp)
	movabsq	$.LCPI0_5, %rax
	vdivss	%xmm2, %xmm1, %xmm1
	vmovss	%xmm2, 2112(%rsp)
	vmovss	(%rsi), %xmm2
	vmovss	(%rax), %xmm5
	movabsq	$.LCPI0_6, %rax
	vmovss	%xmm2, 1920(%rsp)
	vmovss	(%rax), %xmm2
	vmovss	%xmm5, 1664(%rsp)
	vmovss	%xmm1, 832(%rsp)
	vmovss	%xmm2, 1600(%rsp)
	jmp	.LBB0_96
	.p2align	4
.LBB0_141:
	movq	144(%rsp), %rax
	incq	%rax
	movq	%rax, 144(%rsp)
	cmpq	176(%rsp), %rax
	je	.LBB0_142
.LBB0_96:
	movq	168(%rsp), %rax
	jmp	.LBB0_97
	.p2align	4
.LBB0_140:
	movq	1536(%rsp), %rax
	incq	%rax
	cmpq	184(%rsp), %rax
	je	.LBB0_141
.LBB0_97:
	movq	192(%rsp), %rsi
	movq	%rax, 1536(%rsp)
	jmp	.LBB0_98
	.p2align	4
.LBB0_139:
	movq	768(%rsp), %rsi
	movq	88(%rsp), %rcx
	movq	56(%rsp), %rdx
	incq	%rsi
	cmpq	128(%rsp), %rsi
	je	.LBB0_140
.LBB0_98:
	movq	%rsi, 768(%rsp)
	testl	%edx, %edx
	js	.LBB0_99
	movq	200(%rsp), %rax
	vpxor	%xmm6, %xmm6, %xmm6
	movl	1984(%rsp), %r8d
	vmovss	24(%rax), %xmm8
	vmovss	4(%rax), %xmm5
	vmovss	(%rax), %xmm7
	vmovss	8(%rax), %xmm1
	vmovss	12(%rax), %xmm2
	vmovss	16(%rax), %xmm12
	vmovss	20(%rax), %xmm13
	vmovups	%xmm8, 1344(%rsp)
	vmovss	28(%rax), %xmm8
	vsubss	%xmm5, %xmm6, %xmm10
	vsubss	%xmm1, %xmm6, %xmm11
	vmovups	%xmm2, 640(%rsp)
	vmovups	%xmm12, 576(%rsp)
	vmovups	%xmm13, 512(%rsp)
	vmulss	%xmm12, %xmm10, %xmm10
	vmovups	%xmm8, 1280(%rsp)
	vmovss	32(%rax), %xmm8
	vmovups	%xmm8, 1216(%rsp)
	vmovss	36(%rax), %xmm8
	vmovups	%xmm8, 1152(%rsp)
	vmovss	40(%rax), %xmm8
	vmovups	%xmm8, 1088(%rsp)
	vmovss	44(%rax), %xmm8
	vmovups	%xmm8, 1024(%rsp)
	vsubss	%xmm7, %xmm6, %xmm8
	vmulss	%xmm2, %xmm8, %xmm8
	vaddss	%xmm10, %xmm8, %xmm8
	vmulss	%xmm13, %xmm11, %xmm10
	vaddss	%xmm8, %xmm10, %xmm8
	vandps	%xmm0, %xmm8, %xmm10
	vaddss	%xmm3, %xmm10, %xmm10
	vmulss	1920(%rsp), %xmm10, %xmm10
	testl	%edi, %edi
	js	.LBB0_103
	movl	-4(%rcx,%rdx,4), %r8d
	shll	$2, %r8d
.LBB0_103:
	cmpl	%esi, %r8d
	jle	.LBB0_139
	vaddss	%xmm3, %xmm10, %xmm10
	vmovups	640(%rsp), %xmm13
	vxorps	%xmm2, %xmm2, %xmm2
	vmovups	576(%rsp), %xmm14
	vmovups	512(%rsp), %xmm15
	vandps	1216(%rsp), %xmm0, %xmm12
	movq	768(%rsp), %rax
	movl	%r8d, 2368(%rsp)
	vsubss	%xmm10, %xmm8, %xmm11
	vaddss	%xmm10, %xmm8, %xmm8
	vandps	1344(%rsp), %xmm0, %xmm10
	movl	%eax, %esi
	vmaxss	%xmm2, %xmm8, %xmm16
	vmaxss	%xmm2, %xmm11, %xmm19
	vandps	1280(%rsp), %xmm0, %xmm11
	vmovss	1664(%rsp), %xmm2
	vandps	%xmm0, %xmm13, %xmm8
	vmovss	%xmm16, 2048(%rsp)
	vaddss	%xmm10, %xmm8, %xmm8
	vandps	1152(%rsp), %xmm0, %xmm10
	vaddss	%xmm10, %xmm8, %xmm8
	vandps	%xmm0, %xmm14, %xmm10
	vaddss	%xmm11, %xmm10, %xmm10
	vandps	1088(%rsp), %xmm0, %xmm11
	vaddss	%xmm11, %xmm10, %xmm10
	vandps	%xmm0, %xmm15, %xmm11
	vaddss	%xmm12, %xmm11, %xmm11
	vandps	1024(%rsp), %xmm0, %xmm12
	vaddss	%xmm12, %xmm11, %xmm11
	vmulss	%xmm2, %xmm8, %xmm12
	vmulss	%xmm8, %xmm16, %xmm8
	vsubss	%xmm12, %xmm13, %xmm17
	vaddss	%xmm12, %xmm13, %xmm12
	vmovss	%xmm12, 1792(%rsp)
	vmulss	%xmm2, %xmm10, %xmm12
	vmovss	%xmm17, 72(%rsp)
	vsubss	%xmm12, %xmm14, %xmm13
	vaddss	%xmm12, %xmm14, %xmm12
	vmovss	%xmm12, 96(%rsp)
	vmulss	%xmm2, %xmm11, %xmm12
	vmovss	%xmm13, 1728(%rsp)
	vsubss	%xmm12, %xmm15, %xmm2
	vaddss	%xmm12, %xmm15, %xmm6
	vandps	%xmm0, %xmm7, %xmm12
	vaddss	%xmm12, %xmm8, %xmm8
	vmovss	1600(%rsp), %xmm12
	vmovss	%xmm6, 960(%rsp)
	vmulss	%xmm10, %xmm16, %xmm6
	vmovss	%xmm2, 2176(%rsp)
	vmulss	%xmm12, %xmm8, %xmm8
	vsubss	%xmm8, %xmm7, %xmm27
	vaddss	%xmm8, %xmm7, %xmm28
	vandps	%xmm0, %xmm5, %xmm7
	vaddss	%xmm7, %xmm6, %xmm7
	vmovss	%xmm28, 384(%rsp)
	vmovss	%xmm27, 320(%rsp)
	vmulss	%xmm7, %xmm12, %xmm7
	vsubss	%xmm7, %xmm5, %xmm29
	vaddss	%xmm7, %xmm5, %xmm30
	vmulss	%xmm11, %xmm16, %xmm7
	vandps	%xmm0, %xmm1, %xmm5
	vaddss	%xmm5, %xmm7, %xmm5
	vsubss	%xmm19, %xmm16, %xmm7
	vmulss	%xmm5, %xmm12, %xmm5
	vaddss	%xmm5, %xmm1, %xmm6
	vsubss	%xmm5, %xmm1, %xmm31
	vmovss	%xmm6, 704(%rsp)
	jmp	.LBB0_105
	.p2align	4
.LBB0_125:
	vmovss	2048(%rsp), %xmm1
.LBB0_126:
	movq	256(%rsp), %rax
	movq	104(%rsp), %r8
	vmovss	2112(%rsp), %xmm8
	shll	$7, %ecx
	addl	%ebx, %ecx
	orl	%esi, %ecx
	leal	(%rax,%rax), %edi
	subl	%r8d, %edi
	incl	%edi
	vcvtsi2ss	%edi, %xmm9, %xmm2
	leal	(%rdx,%rdx), %edi
	notl	%edi
	addl	%r8d, %edi
	vcvtsi2ss	%edi, %xmm9, %xmm5
	vdivss	%xmm8, %xmm2, %xmm2
	movl	%r8d, %edi
	imull	%edx, %edi
	vdivss	%xmm8, %xmm5, %xmm5
	addl	%eax, %edi
	vmulss	1344(%rsp), %xmm2, %xmm8
	vmulss	1280(%rsp), %xmm2, %xmm10
	vmulss	1216(%rsp), %xmm2, %xmm2
	movslq	%edi, %rax
	vaddss	640(%rsp), %xmm8, %xmm8
	vmulss	1152(%rsp), %xmm5, %xmm11
	vmulss	1088(%rsp), %xmm5, %xmm12
	vaddss	576(%rsp), %xmm10, %xmm10
	vaddss	512(%rsp), %xmm2, %xmm2
	vmulss	1024(%rsp), %xmm5, %xmm5
	vaddss	%xmm8, %xmm11, %xmm8
	vaddss	%xmm10, %xmm12, %xmm10
	vaddss	%xmm2, %xmm5, %xmm2
	vmulss	%xmm8, %xmm8, %xmm5
	vmulss	%xmm10, %xmm10, %xmm8
	vmulss	%xmm2, %xmm2, %xmm2
	vaddss	%xmm5, %xmm8, %xmm5
	vaddss	%xmm5, %xmm2, %xmm2
	vsqrtss	%xmm2, %xmm2, %xmm2
	vmulss	%xmm2, %xmm1, %xmm1
	vmovss	%xmm1, (%r9,%rax,4)
	movl	%ecx, (%r10,%rax,4)
.LBB0_138:
	movl	2432(%rsp), %esi
	movl	2368(%rsp), %r8d
	movl	68(%rsp), %edi
	addl	124(%rsp), %esi
	cmpl	%r8d, %esi
	jge	.LBB0_139
.LBB0_105:
	movl	%esi, 2432(%rsp)
	testl	%edi, %edi
	js	.LBB0_106
	movl	%esi, %eax
	sarl	$2, %eax
	movq	136(%rsp), %r11
	movl	%esi, %r15d
	andl	$3, %r15d
	andl	$1, %esi
	leal	(%rax,%rax,2), %eax
	addl	%edi, %eax
	movslq	%eax, %rcx
	movl	(%r11,%rcx,4), %edx
	movl	4(%r11,%rcx,4), %r8d
	movzwl	%dx, %eax
	shrl	$16, %edx
	leal	(%rsi,%rax,2), %eax
	movl	%r15d, %esi
	addl	8(%r11,%rcx,4), %r15d
	shrl	%esi
	leal	(%rsi,%rdx,2), %edx
	sarl	$2, %r15d
	jmp	.LBB0_108
	.p2align	4
.LBB0_106:
	movl	%esi, %eax
	andl	$1431655765, %eax
	movl	$1, %r8d
	xorl	%r15d, %r15d
	movl	%eax, %ecx
	shrl	%ecx
	orl	%eax, %ecx
	andl	$858993459, %ecx
	movl	%ecx, %eax
	shrl	$2, %eax
	orl	%ecx, %eax
	andl	$252645135, %eax
	movl	%eax, %ecx
	shrl	$4, %ecx
	orl	%eax, %ecx
	movzbl	%cl, %eax
	shrl	$8, %ecx
	andl	$65280, %ecx
	orl	%ecx, %eax
	movl	%esi, %ecx
	shrl	%ecx
	andl	$1431655765, %ecx
	movl	%ecx, %edx
	shrl	%edx
	orl	%ecx, %edx
	andl	$858993459, %edx
	movl	%edx, %ecx
	shrl	$2, %ecx
	orl	%edx, %ecx
	andl	$252645135, %ecx
	movl	%ecx, %esi
	shrl	$4, %esi
	orl	%ecx, %esi
	movzbl	%sil, %edx
	shrl	$8, %esi
	andl	$65280, %esi
	orl	%esi, %edx
.LBB0_108:
	movl	1856(%rsp), %esi
	cmpl	%eax, %edx
	movl	%eax, %ecx
	vxorps	%xmm5, %xmm5, %xmm5
	cmovgl	%edx, %ecx
	shlxl	%esi, %ecx, %ecx
	cmpl	104(%rsp), %ecx
	jge	.LBB0_138
	movl	1856(%rsp), %ecx
	movq	896(%rsp), %rsi
	vmovss	832(%rsp), %xmm2
	movq	%rax, 256(%rsp)
	shlxl	%ecx, %eax, %edi
	shlxl	%ecx, %edx, %r14d
	movq	104(%rsp), %rcx
	vcvtsi2ss	%edi, %xmm9, %xmm1
	leal	(%rdi,%rsi), %r13d
	movq	%rdi, 1408(%rsp)
	movabsq	$.LCPI0_14, %rdi
	leal	(%r14,%rsi), %eax
	movq	56(%rsp), %rsi
	movq	%r14, 2304(%rsp)
	vmovss	(%rdi), %xmm8
	movabsq	$.LCPI0_20, %rdi
	vmulss	%xmm1, %xmm2, %xmm1
	cmpl	%ecx, %r13d
	cmovgel	%ecx, %r13d
	cmpl	%ecx, %eax
	movl	%esi, %r11d
	movl	$1, %esi
	cmovgel	%ecx, %eax
	xorl	%ecx, %ecx
	cmpl	$1, %r8d
	movl	%r13d, 2240(%rsp)
	cmovel	%ecx, %r11d
	movl	%eax, 80(%rsp)
	shlxl	%r11d, %esi, %esi
	vaddss	%xmm1, %xmm8, %xmm12
	vcvtsi2ss	%r13d, %xmm9, %xmm1
	vcvtsi2ss	%esi, %xmm9, %xmm13
	movabsq	$.LCPI0_15, %rsi
	vmovss	%xmm8, 448(%rsp)
	vmovss	(%rsi), %xmm10
	vmulss	%xmm1, %xmm2, %xmm1
	vaddss	%xmm1, %xmm8, %xmm14
	vcvtsi2ss	%eax, %xmm9, %xmm1
	vmulss	%xmm1, %xmm2, %xmm1
	vsubss	%xmm1, %xmm10, %xmm15
	vcvtsi2ss	%r14d, %xmm9, %xmm1
	movabsq	$.LCPI0_21, %r14
	vmulss	%xmm1, %xmm2, %xmm1
	vmovups	1344(%rsp), %xmm2
	vsubss	%xmm1, %xmm10, %xmm16
	vmulss	%xmm2, %xmm12, %xmm1
	vmulss	%xmm2, %xmm14, %xmm10
	vmovups	1152(%rsp), %xmm2
	vminss	%xmm10, %xmm1, %xmm11
	vmaxss	%xmm10, %xmm1, %xmm1
	vaddss	1792(%rsp), %xmm1, %xmm1
	vaddss	72(%rsp), %xmm11, %xmm11
	vmulss	%xmm15, %xmm2, %xmm17
	vmulss	%xmm16, %xmm2, %xmm18
	vmovups	1280(%rsp), %xmm2
	vmaxss	%xmm18, %xmm17, %xmm10
	vminss	%xmm18, %xmm17, %xmm20
	vaddss	%xmm1, %xmm10, %xmm10
	vaddss	%xmm20, %xmm11, %xmm20
	vmulss	%xmm2, %xmm12, %xmm1
	vmulss	%xmm14, %xmm2, %xmm17
	vmovups	1088(%rsp), %xmm2
	vminss	%xmm17, %xmm1, %xmm11
	vmaxss	%xmm17, %xmm1, %xmm1
	vaddss	96(%rsp), %xmm1, %xmm1
	vaddss	1728(%rsp), %xmm11, %xmm11
	vmulss	%xmm15, %xmm2, %xmm18
	vmulss	%xmm16, %xmm2, %xmm21
	vmovups	1216(%rsp), %xmm2
	vmaxss	%xmm21, %xmm18, %xmm17
	vminss	%xmm21, %xmm18, %xmm22
	vaddss	%xmm17, %xmm1, %xmm1
	vaddss	%xmm22, %xmm11, %xmm11
	vdivss	%xmm13, %xmm7, %xmm22
	vmulss	%xmm12, %xmm2, %xmm17
	vmulss	%xmm2, %xmm14, %xmm14
	vmovups	1024(%rsp), %xmm2
	vminss	%xmm14, %xmm17, %xmm12
	vmaxss	%xmm14, %xmm17, %xmm14
	vaddss	2176(%rsp), %xmm12, %xmm12
	vaddss	960(%rsp), %xmm14, %xmm14
	vmulss	%xmm2, %xmm15, %xmm15
	vmulss	%xmm16, %xmm2, %xmm16
	vminss	%xmm16, %xmm15, %xmm18
	vmaxss	%xmm16, %xmm15, %xmm15
	vaddss	%xmm18, %xmm12, %xmm12
	vaddss	%xmm15, %xmm14, %xmm21
	.p2align	4
.LBB0_110:
	vcvtsi2ss	%r8d, %xmm9, %xmm13
	leal	1(%r8), %r13d
	movabsq	$.LCPI0_17, %rsi
	vmulss	%xmm13, %xmm22, %xmm13
	vsubss	%xmm7, %xmm13, %xmm13
	vaddss	%xmm13, %xmm19, %xmm23
	vcvtsi2ss	%r13d, %xmm9, %xmm13
	vmulss	%xmm13, %xmm22, %xmm13
	vsubss	%xmm7, %xmm13, %xmm13
	vaddss	%xmm13, %xmm19, %xmm24
	vmulss	%xmm23, %xmm20, %xmm13
	vmulss	%xmm24, %xmm20, %xmm14
	vmulss	%xmm24, %xmm10, %xmm15
	vminss	%xmm14, %xmm13, %xmm13
	vaddss	%xmm13, %xmm27, %xmm14
	vmovss	(%rsi), %xmm13
	vmaxss	%xmm13, %xmm14, %xmm16
	vmulss	%xmm23, %xmm10, %xmm14
	vmaxss	%xmm15, %xmm14, %xmm14
	vaddss	%xmm14, %xmm28, %xmm14
	vminss	%xmm3, %xmm14, %xmm18
	vucomiss	%xmm18, %xmm16
	ja	.LBB0_117
	vmulss	%xmm23, %xmm11, %xmm14
	vmulss	%xmm24, %xmm11, %xmm15
	vmulss	%xmm24, %xmm1, %xmm17
	vminss	%xmm15, %xmm14, %xmm14
	vaddss	%xmm14, %xmm29, %xmm14
	vmaxss	%xmm13, %xmm14, %xmm15
	vmulss	%xmm23, %xmm1, %xmm14
	vmaxss	%xmm17, %xmm14, %xmm14
	vaddss	%xmm14, %xmm30, %xmm14
	vminss	%xmm3, %xmm14, %xmm17
	vucomiss	%xmm17, %xmm15
	ja	.LBB0_117
	vmulss	%xmm23, %xmm12, %xmm14
	vmulss	%xmm24, %xmm12, %xmm25
	vminss	%xmm25, %xmm14, %xmm14
	vmulss	%xmm24, %xmm21, %xmm25
	vaddss	%xmm14, %xmm31, %xmm14
	vmaxss	%xmm13, %xmm14, %xmm14
	vmulss	%xmm23, %xmm21, %xmm13
	vmaxss	%xmm25, %xmm13, %xmm13
	vaddss	%xmm6, %xmm13, %xmm13
	vminss	%xmm3, %xmm13, %xmm13
	vucomiss	%xmm13, %xmm14
	ja	.LBB0_117
	vsubss	%xmm18, %xmm5, %xmm25
	vsubss	%xmm17, %xmm5, %xmm26
	vsubss	%xmm13, %xmm5, %xmm2
	movabsq	$.LCPI0_18, %rsi
	vmaxss	%xmm25, %xmm16, %xmm25
	vmaxss	%xmm26, %xmm15, %xmm26
	vmaxss	%xmm2, %xmm14, %xmm2
	vmaxss	%xmm5, %xmm25, %xmm25
	vmaxss	%xmm5, %xmm26, %xmm26
	vmaxss	%xmm5, %xmm2, %xmm2
	vmulss	%xmm25, %xmm25, %xmm25
	vmulss	%xmm26, %xmm26, %xmm26
	vmulss	%xmm2, %xmm2, %xmm2
	vaddss	%xmm26, %xmm25, %xmm25
	vaddss	%xmm2, %xmm25, %xmm2
	vucomiss	(%rsi), %xmm2
	ja	.LBB0_117
	vmovaps	%xmm31, %xmm6
	vsubss	%xmm16, %xmm18, %xmm2
	vmovss	(%rdi), %xmm31
	vmovss	(%r14), %xmm5
	vxorps	%xmm28, %xmm28, %xmm28
	vmovaps	%xmm30, %xmm27
	vmovaps	%xmm29, %xmm30
	vmovd	%xmm2, %esi
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovaps	%xmm31, %xmm2
	vmovss	%xmm16, %xmm2, %xmm2 {%k1}
	vsubss	%xmm15, %xmm17, %xmm16
	vmovaps	%xmm5, %xmm26
	vmovss	%xmm18, %xmm26, %xmm26 {%k1}
	vbroadcastss	(%r12), %xmm18
	vmovaps	%xmm31, %xmm25
	vmovaps	%xmm5, %xmm8
	vmovd	%xmm16, %esi
	vmovaps	%xmm31, %xmm16
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovss	%xmm15, %xmm25, %xmm25 {%k1}
	vsubss	%xmm14, %xmm13, %xmm15
	vmovss	%xmm17, %xmm8, %xmm8 {%k1}
	vmovaps	%xmm5, %xmm17
	vmovd	%xmm15, %esi
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	movabsq	$.LCPI0_23, %rsi
	vmovss	%xmm13, %xmm17, %xmm17 {%k1}
	vxorps	%xmm18, %xmm26, %xmm13
	vmovss	%xmm14, %xmm16, %xmm16 {%k1}
	vmaxss	%xmm13, %xmm2, %xmm13
	vxorps	%xmm18, %xmm2, %xmm2
	vmaxss	%xmm26, %xmm2, %xmm2
	vmaxss	%xmm28, %xmm13, %xmm13
	vmulss	%xmm2, %xmm2, %xmm2
	vmulss	%xmm13, %xmm13, %xmm14
	vmovss	(%rsi), %xmm13
	movabsq	$.LCPI0_24, %rsi
	vandps	%xmm0, %xmm14, %xmm15
	vmulss	%xmm13, %xmm15, %xmm15
	vsubss	%xmm15, %xmm14, %xmm15
	vmovss	(%rsi), %xmm14
	movabsq	$.LCPI0_25, %rsi
	vaddss	%xmm14, %xmm15, %xmm26
	vandps	%xmm0, %xmm2, %xmm15
	vmulss	%xmm13, %xmm15, %xmm15
	vaddss	%xmm2, %xmm15, %xmm2
	vmovss	(%rsi), %xmm15
	vaddss	%xmm2, %xmm15, %xmm2
	vsubss	%xmm26, %xmm2, %xmm29
	vmovd	%xmm29, %esi
	vmovaps	%xmm31, %xmm29
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovss	%xmm26, %xmm29, %xmm29 {%k1}
	vmovaps	%xmm5, %xmm26
	vmovss	%xmm2, %xmm26, %xmm26 {%k1}
	vxorps	%xmm18, %xmm8, %xmm2
	vmaxss	%xmm2, %xmm25, %xmm2
	vxorps	%xmm18, %xmm25, %xmm25
	vmaxss	%xmm8, %xmm25, %xmm8
	vmaxss	%xmm28, %xmm2, %xmm2
	vmulss	%xmm8, %xmm8, %xmm8
	vmulss	%xmm2, %xmm2, %xmm2
	vandps	%xmm0, %xmm2, %xmm25
	vmulss	%xmm13, %xmm25, %xmm25
	vsubss	%xmm25, %xmm2, %xmm2
	vandps	%xmm0, %xmm8, %xmm25
	vmulss	%xmm13, %xmm25, %xmm25
	vaddss	%xmm2, %xmm14, %xmm2
	vaddss	%xmm25, %xmm8, %xmm8
	vaddss	%xmm15, %xmm8, %xmm8
	vsubss	%xmm2, %xmm8, %xmm25
	vmovd	%xmm25, %esi
	vmovaps	%xmm31, %xmm25
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovss	%xmm2, %xmm25, %xmm25 {%k1}
	vaddss	%xmm25, %xmm29, %xmm2
	vmovaps	%xmm5, %xmm25
	vmovss	%xmm8, %xmm25, %xmm25 {%k1}
	vaddss	%xmm25, %xmm26, %xmm8
	vandps	%xmm0, %xmm2, %xmm25
	vmulss	%xmm13, %xmm25, %xmm25
	vsubss	%xmm25, %xmm2, %xmm2
	vandps	%xmm0, %xmm8, %xmm25
	vmulss	%xmm13, %xmm25, %xmm25
	vaddss	%xmm2, %xmm14, %xmm2
	vaddss	%xmm8, %xmm25, %xmm8
	vaddss	%xmm15, %xmm8, %xmm8
	vsubss	%xmm2, %xmm8, %xmm25
	vmovd	%xmm25, %esi
	vmovaps	%xmm31, %xmm25
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovss	%xmm2, %xmm25, %xmm25 {%k1}
	vmovaps	%xmm5, %xmm2
	vmovss	%xmm8, %xmm2, %xmm2 {%k1}
	vxorps	%xmm18, %xmm17, %xmm8
	vmaxss	%xmm8, %xmm16, %xmm8
	vxorps	%xmm18, %xmm16, %xmm16
	vmaxss	%xmm17, %xmm16, %xmm16
	vmaxss	%xmm28, %xmm8, %xmm8
	vmulss	%xmm16, %xmm16, %xmm16
	vmulss	%xmm8, %xmm8, %xmm8
	vandps	%xmm0, %xmm8, %xmm17
	vmulss	%xmm13, %xmm17, %xmm17
	vsubss	%xmm17, %xmm8, %xmm8
	vandps	%xmm0, %xmm16, %xmm17
	vmulss	%xmm13, %xmm17, %xmm17
	vaddss	%xmm14, %xmm8, %xmm8
	vaddss	%xmm17, %xmm16, %xmm16
	vaddss	%xmm15, %xmm16, %xmm16
	vsubss	%xmm8, %xmm16, %xmm17
	vmovd	%xmm17, %esi
	vmovaps	%xmm31, %xmm17
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	kmovd	%esi, %k1
	vmovss	%xmm8, %xmm17, %xmm17 {%k1}
	vaddss	%xmm17, %xmm25, %xmm8
	vmovaps	%xmm5, %xmm17
	vmovss	%xmm16, %xmm17, %xmm17 {%k1}
	vaddss	%xmm17, %xmm2, %xmm2
	vmovss	448(%rsp), %xmm17
	vandps	%xmm0, %xmm8, %xmm16
	vmulss	%xmm13, %xmm16, %xmm16
	vsubss	%xmm16, %xmm8, %xmm8
	vandps	%xmm0, %xmm2, %xmm16
	vmulss	%xmm13, %xmm16, %xmm16
	vaddss	%xmm14, %xmm8, %xmm8
	vaddss	%xmm2, %xmm16, %xmm2
	vaddss	%xmm2, %xmm15, %xmm2
	vsubss	%xmm8, %xmm2, %xmm16
	vaddss	%xmm17, %xmm8, %xmm8
	vaddss	%xmm17, %xmm2, %xmm2
	vmovd	%xmm16, %esi
	addl	%esi, %esi
	cmpl	$-16777216, %esi
	setb	%sil
	incl	%ecx
	kmovd	%esi, %k1
	vmovss	%xmm8, %xmm31, %xmm31 {%k1}
	vmovss	%xmm2, %xmm5, %xmm5 {%k1}
	vandps	%xmm0, %xmm31, %xmm2
	vmulss	%xmm2, %xmm13, %xmm2
	vsubss	%xmm2, %xmm31, %xmm2
	vaddss	%xmm2, %xmm14, %xmm14
	vandps	%xmm0, %xmm5, %xmm2
	vmulss	%xmm2, %xmm13, %xmm2
	vaddss	%xmm5, %xmm2, %xmm2
	vxorps	%xmm5, %xmm5, %xmm5
	vaddss	%xmm2, %xmm15, %xmm13
	vsubss	%xmm14, %xmm13, %xmm2
	vmovd	%xmm2, %esi
	addl	%esi, %esi
	cmpl	$-16777217, %esi
	ja	.LBB0_119
	vcmpltss	%xmm5, %xmm13, %k0
	vcmpltss	%xmm14, %xmm5, %k1
	korw	%k0, %k1, %k0
	kmovd	%k0, %esi
	testb	$1, %sil
	je	.LBB0_119
	vmovaps	%xmm30, %xmm29
	vmovaps	%xmm27, %xmm30
	vmovaps	%xmm6, %xmm31
	vmovss	320(%rsp), %xmm27
	vmovss	384(%rsp), %xmm28
	vmovss	704(%rsp), %xmm6
	.p2align	4
.LBB0_117:
	andnl	%r13d, %r8d, %esi
	decl	%esi
	popcntl	%esi, %esi
	sarxl	%esi, %r13d, %r8d
	cmpl	$1, %r8d
	je	.LBB0_124
	movl	$1, %r13d
	subl	%esi, %r11d
	shlxl	%esi, %r13d, %esi
	vcvtsi2ss	%esi, %xmm9, %xmm13
	vmulss	%xmm13, %xmm22, %xmm22
	jmp	.LBB0_110
.LBB0_119:
	vmovaps	%xmm6, %xmm31
	cmpl	56(%rsp), %r11d
	jg	.LBB0_122
	movabsq	$.LCPI0_27, %rsi
	vmovaps	%xmm30, %xmm29
	vmovaps	%xmm27, %xmm30
	vmovd	320(%rsp), %xmm27
	vmovss	384(%rsp), %xmm28
	vmovd	704(%rsp), %xmm6
	addl	%r8d, %r8d
	incl	%r11d
	vmovss	(%rsi), %xmm13
	vmulss	%xmm13, %xmm22, %xmm22
	jmp	.LBB0_110
	.p2align	4
.LBB0_124:
	addl	%r15d, %ecx
	movl	76(%rsp), %edi
	xorl	%esi, %esi
	cmpl	56(%rsp), %edi
	je	.LBB0_125
	movl	2240(%rsp), %r15d
	movl	80(%rsp), %r13d
	movq	1408(%rsp), %r11
	movq	2304(%rsp), %r14
	leal	-2147483648(%rcx), %edx
	movl	$1, %r8d
	movl	%r15d, %eax
	movl	%r13d, %esi
	subl	%r11d, %eax
	subl	%r14d, %esi
	imull	%eax, %esi
	movl	%esi, %eax
	notl	%eax
	testl	%esi, %esi
	movl	%esi, %edi
	cmovel	%r8d, %edi
	orl	%eax, %edx
	movl	%ecx, %eax
	cltd
	cmovel	%r8d, %edi
	idivl	%edi
	cmpl	%r14d, %r13d
	jle	.LBB0_138
	cmpl	%r11d, %r15d
	jle	.LBB0_138
	imull	%eax, %esi
	movslq	80(%rsp), %rdx
	movslq	%r15d, %r15
	movslq	%r14d, %r8
	vpbroadcastd	%eax, %zmm1
	movq	%r15, %r13
	subl	%esi, %ecx
	movslq	%r11d, %rsi
	subq	%rsi, %r13
	movq	%rsi, 1408(%rsp)
	movq	%r13, 80(%rsp)
	andl	$-16, %r13d
	movq	%rdx, 448(%rsp)
	leaq	(%r13,%rsi), %rdx
	movq	%rdx, 256(%rsp)
	movq	104(%rsp), %rdx
	imulq	%r8, %rdx
	addq	%rsi, %rdx
	leaq	(%r9,%rdx,4), %r14
	leaq	(%r10,%rdx,4), %rsi
	movq	1472(%rsp), %rdx
	imulq	%r8, %rdx
	leaq	(%r10,%rdx), %rdi
	addq	%r9, %rdx
	jmp	.LBB0_130
	.p2align	4
.LBB0_136:
	movq	1472(%rsp), %r11
	incq	%r8
	movabsq	$.LCPI0_22, %r12
	addq	%r11, %r14
	addq	%r11, %rsi
	addq	%r11, %rdi
	addq	%r11, %rdx
	cmpq	448(%rsp), %r8
	je	.LBB0_138
.LBB0_130:
	testq	%r13, %r13
	je	.LBB0_131
	movabsq	$.LCPI0_32, %r11
	vpbroadcastd	%ecx, %zmm2
	movabsq	$.LCPI0_33, %r12
	vpaddd	(%r11), %zmm2, %zmm8
	xorl	%r11d, %r11d
	.p2align	4
.LBB0_134:
	vpcmpgtd	%zmm9, %zmm8, %k0
	vpaddd	(%r12){1to16}, %zmm8, %zmm8
	vmovdqu64	%zmm9, (%r14,%r11,4)
	vpmovm2d	%k0, %zmm2
	vpsubd	%zmm2, %zmm1, %zmm2
	vpslld	$7, %zmm2, %zmm2
	vpaddd	%zmm4, %zmm2, %zmm2
	vmovdqu64	%zmm2, (%rsi,%r11,4)
	addq	$16, %r11
	cmpq	%r13, %r11
	jb	.LBB0_134
	movq	256(%rsp), %r11
	subl	%r13d, %ecx
	cmpq	%r13, 80(%rsp)
	jne	.LBB0_132
	jmp	.LBB0_136
	.p2align	4
.LBB0_131:
	movq	1408(%rsp), %r11
	.p2align	4
.LBB0_132:
	xorl	%r12d, %r12d
	testl	%ecx, %ecx
	movl	$0, (%rdx,%r11,4)
	setg	%r12b
	decl	%ecx
	addl	%eax, %r12d
	shll	$7, %r12d
	addl	%ebx, %r12d
	movl	%r12d, (%rdi,%r11,4)
	incq	%r11
	cmpq	%r11, %r15
	jne	.LBB0_132
	jmp	.LBB0_136
.LBB0_122:
	vmovss	704(%rsp), %xmm6
	movq	56(%rsp), %r11
	vmovaps	%xmm30, %xmm29
	cmpl	%r11d, 76(%rsp)
	jne	.LBB0_137
	movabsq	$.LCPI0_27, %rsi
	vaddss	%xmm24, %xmm23, %xmm1
	vmovaps	%xmm27, %xmm30
	vmovss	320(%rsp), %xmm27
	vmovss	384(%rsp), %xmm28
	addl	%r15d, %ecx
	vmulss	(%rsi), %xmm1, %xmm1
	movl	$1, %esi
	jmp	.LBB0_126
.LBB0_137:
	movq	88(%rsp), %rdi
	movl	$1, %esi
	vmovaps	%xmm27, %xmm30
	shll	$16, %edx
	addl	%r15d, %ecx
	lock		xaddl	%esi, (%rdi,%r11,4)
	vmovss	320(%rsp), %xmm27
	vmovss	384(%rsp), %xmm28
	orl	256(%rsp), %edx
	movq	136(%rsp), %rdi
	leal	(%rsi,%rsi,2), %esi
	addl	116(%rsp), %esi
	movslq	%esi, %rax
	movl	%edx, (%rdi,%rax,4)
	movl	%r8d, 4(%rdi,%rax,4)
	movl	%ecx, 8(%rdi,%rax,4)
	jmp	.LBB0_138
	.p2align	4
.LBB0_99:
	cmpl	$31, %esi
	jg	.LBB0_139
	movslq	768(%rsp), %rax
	movq	88(%rsp), %rcx
	movl	$0, (%rcx,%rax,4)
	jmp	.LBB0_139
.LBB0_142:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	vzeroupper
	retq
.LBB0_1:
	movq	104(%rsp), %r14
	movq	%r11, %rcx
	movabsq	$.LCPI0_0, %r11
	movl	76(%rsp), %esi
	movl	$1, %eax
	movq	56(%rsp), %rdx
	movl	$1, %ebx
	movq	%r8, %r15
	xorl	%r8d, %r8d
	movabsq	$.LCPI0_9, %r13
	vxorps	%xmm16, %xmm16, %xmm16
	vxorps	%xmm17, %xmm17, %xmm17
	vcvtsi2ss	%r14d, %xmm15, %xmm1
	vmovss	(%r11), %xmm0
	movl	%esi, %edi
	subl	56(%rsp), %edi
	subl	%r14d, %eax
	leal	(,%rdx,4), %edx
	vpbroadcastd	%r14d, %zmm26
	vpbroadcastq	%r14, %zmm25
	movl	$1, %r14d
	vmovdqu64	%zmm26, 2880(%rsp)
	vmovdqu64	%zmm25, 3648(%rsp)
	vpbroadcastd	%edx, %zmm9
	movl	124(%rsp), %edx
	andl	$31, %edi
	cmpl	56(%rsp), %esi
	movabsq	$.LCPI0_10, %rsi
	shlxl	%edi, %ebx, %r11d
	vpbroadcastd	%edi, %zmm24
	movq	56(%rsp), %rdi
	movl	$65535, %ebx
	vmovdqu64	%zmm24, 2944(%rsp)
	vdivss	%xmm1, %xmm0, %xmm2
	vbroadcastss	%xmm1, %zmm1
	vpternlogd	$255, %zmm0, %zmm0, %zmm0
	vmovups	%zmm1, 3520(%rsp)
	vpbroadcastd	%edx, %zmm1
	cmovnel	%r8d, %ebx
	movl	68(%rsp), %r8d
	movabsq	$.LCPI0_1, %rdx
	vpbroadcastd	%edi, %zmm27
	movl	116(%rsp), %edi
	vmovdqu64	%zmm1, 3456(%rsp)
	kmovd	%ebx, %k0
	movabsq	$.LCPI0_27, %rbx
	kmovw	%k0, 72(%rsp)
	vmovdqu64	%zmm27, 1472(%rsp)
	vpbroadcastd	%r8d, %zmm3
	movq	%r15, %r8
	vpbroadcastd	%edi, %zmm4
	vpcmpgtd	%zmm0, %zmm3, %k0
	vmovdqu64	%zmm3, 3008(%rsp)
	vpbroadcastd	%r11d, %zmm3
	movq	%rcx, %r11
	movabsq	$.LCPI0_23, %rdi
	vmovdqu64	%zmm4, 3712(%rsp)
	vmovdqu64	%zmm3, 2816(%rsp)
	vmovss	(%r15), %xmm3
	movabsq	$.LCPI0_8, %r15
	kmovw	%k0, 102(%rsp)
	vbroadcastss	%xmm2, %zmm2
	vmovups	%zmm2, 2752(%rsp)
	vpbroadcastd	%eax, %zmm2
	movq	56(%rsp), %rax
	vmovdqu64	%zmm2, 3584(%rsp)
	vbroadcastss	(%rcx), %xmm2
	movabsq	$.LCPI0_16, %rcx
	vmovss	%xmm3, 120(%rsp)
	leal	(%rax,%rax), %eax
	shlxl	%eax, %r14d, %eax
	movl	%eax, 164(%rsp)
	movq	128(%rsp), %rax
	vmovups	%xmm2, 240(%rsp)
	vpbroadcastd	%eax, %zmm1
	movabsq	$.LCPI0_29, %rax
	vpaddd	(%rdx), %zmm1, %zmm1
	movabsq	$.LCPI0_19, %rdx
	vbroadcastss	(%rax), %zmm4
	movabsq	$.LCPI0_30, %rax
	vmovups	(%rax), %zmm5
	movabsq	$.LCPI0_31, %rax
	vmovdqu64	%zmm1, 2496(%rsp)
	vmovups	%zmm4, 2624(%rsp)
	vbroadcastss	(%rax), %zmm4
	movabsq	$.LCPI0_4, %rax
	vmovss	(%rax), %xmm2
	movabsq	$.LCPI0_5, %rax
	vmovups	%zmm5, 2560(%rsp)
	vmovss	(%rax), %xmm3
	movabsq	$.LCPI0_6, %rax
	vmovups	%zmm4, 2688(%rsp)
	vmovss	%xmm2, 160(%rsp)
	vmovss	(%rax), %xmm2
	movq	144(%rsp), %rax
	vmovss	%xmm3, 156(%rsp)
	vmovss	%xmm2, 152(%rsp)
	jmp	.LBB0_2
	.p2align	4
.LBB0_93:
	movq	216(%rsp), %rax
	incq	%rax
	cmpq	176(%rsp), %rax
	je	.LBB0_94
.LBB0_2:
	movq	%rax, 216(%rsp)
	movq	168(%rsp), %rax
	jmp	.LBB0_3
	.p2align	4
.LBB0_92:
	movq	224(%rsp), %rax
	incq	%rax
	cmpq	184(%rsp), %rax
	je	.LBB0_93
.LBB0_3:
	vmovdqu64	2496(%rsp), %zmm14
	movq	%rax, 224(%rsp)
	movq	128(%rsp), %rax
	jmp	.LBB0_4
	.p2align	4
.LBB0_90:
	vmovdqu64	2560(%rsp), %zmm3
	vpcmpltd	2624(%rsp), %zmm14, %k1
	vpmovzxdq	%ymm14, %zmm1
	vmovdqa64	%zmm14, %zmm2
	movq	88(%rsp), %rax
	vpsllq	$32, %zmm1, %zmm1
	vpsraq	$30, %zmm1, %zmm1
	vpermt2d	%zmm16, %zmm3, %zmm2
	kshiftrw	$8, %k1, %k2
	vpscatterqd	%ymm17, (%rax,%zmm1) {%k1}
	vpsraq	$30, %zmm2, %zmm2
	vpscatterqd	%ymm17, (%rax,%zmm2) {%k2}
.LBB0_91:
	vpaddd	2688(%rsp), %zmm14, %zmm14
	movq	232(%rsp), %rax
	addq	$16, %rax
	cmpq	192(%rsp), %rax
	je	.LBB0_92
.LBB0_4:
	cmpl	$0, 56(%rsp)
	movq	%rax, 232(%rsp)
	js	.LBB0_90
	movq	200(%rsp), %rax
	vxorps	%xmm6, %xmm6, %xmm6
	cmpl	$0, 68(%rsp)
	vbroadcastss	28(%rax), %zmm4
	vbroadcastss	24(%rax), %zmm1
	vmovss	4(%rax), %xmm3
	vmovss	(%rax), %xmm2
	vbroadcastss	12(%rax), %zmm7
	vbroadcastss	16(%rax), %zmm8
	vbroadcastss	20(%rax), %zmm10
	vbroadcastss	32(%rax), %zmm11
	vsubss	%xmm3, %xmm6, %xmm5
	vmovups	%zmm4, 896(%rsp)
	vbroadcastss	36(%rax), %zmm4
	vmovups	%zmm1, 960(%rsp)
	vbroadcastss	40(%rax), %zmm1
	vmovups	%zmm11, 832(%rsp)
	vmovups	%zmm7, 1664(%rsp)
	vmovups	%zmm8, 1600(%rsp)
	vmovups	%zmm10, 1536(%rsp)
	vmulss	%xmm5, %xmm8, %xmm5
	vmovups	%zmm4, 640(%rsp)
	vbroadcastss	44(%rax), %zmm4
	vmovups	%zmm1, 576(%rsp)
	vmovss	8(%rax), %xmm1
	movl	164(%rsp), %eax
	vmovups	%zmm4, 512(%rsp)
	vsubss	%xmm2, %xmm6, %xmm4
	vsubss	%xmm1, %xmm6, %xmm6
	vmulss	%xmm7, %xmm4, %xmm4
	vaddss	%xmm5, %xmm4, %xmm4
	vmulss	%xmm6, %xmm10, %xmm5
	vaddss	%xmm4, %xmm5, %xmm4
	vandps	240(%rsp), %xmm4, %xmm5
	vaddss	120(%rsp), %xmm5, %xmm5
	vmulss	160(%rsp), %xmm5, %xmm5
	js	.LBB0_7
	movq	%rsi, %rbx
	movq	%rdi, %rsi
	movq	%r12, %rdi
	movq	%r11, %r12
	movq	%r8, %r11
	movq	88(%rsp), %rax
	movq	56(%rsp), %r8
	movl	-4(%rax,%r8,4), %eax
	movq	%r11, %r8
	movq	%r12, %r11
	movq	%rdi, %r12
	movq	%rsi, %rdi
	movq	%rbx, %rsi
	movabsq	$.LCPI0_27, %rbx
	shll	$2, %eax
.LBB0_7:
	vpbroadcastd	%eax, %zmm20
	movabsq	$.LCPI0_7, %rax
	vpcmpgtd	%zmm14, %zmm20, %k2
	kortestw	%k2, %k2
	je	.LBB0_91
	vaddss	120(%rsp), %xmm5, %xmm5
	vmovups	240(%rsp), %xmm12
	vmovups	1664(%rsp), %zmm15
	vxorps	%xmm7, %xmm7, %xmm7
	vmovups	1600(%rsp), %zmm18
	vmovups	1536(%rsp), %zmm19
	vmovss	156(%rsp), %xmm13
	vmovdqu64	%zmm14, 3904(%rsp)
	vmovdqu64	%zmm20, 3840(%rsp)
	vandps	896(%rsp), %xmm12, %xmm8
	vandps	832(%rsp), %xmm12, %xmm10
	vsubss	%xmm5, %xmm4, %xmm6
	vaddss	%xmm5, %xmm4, %xmm4
	vmaxss	%xmm7, %xmm6, %xmm6
	vmaxss	%xmm7, %xmm4, %xmm4
	vandps	960(%rsp), %xmm12, %xmm7
	vbroadcastss	%xmm4, %zmm5
	vbroadcastss	%xmm6, %zmm28
	vmovups	%zmm5, 3776(%rsp)
	vandps	%xmm12, %xmm15, %xmm5
	vmovups	%zmm28, 384(%rsp)
	vaddss	%xmm7, %xmm5, %xmm5
	vandps	640(%rsp), %xmm12, %xmm7
	vaddss	%xmm7, %xmm5, %xmm5
	vandps	%xmm12, %xmm18, %xmm7
	vaddss	%xmm7, %xmm8, %xmm7
	vandps	576(%rsp), %xmm12, %xmm8
	vaddss	%xmm7, %xmm8, %xmm7
	vandps	%xmm12, %xmm19, %xmm8
	vaddss	%xmm10, %xmm8, %xmm8
	vandps	512(%rsp), %xmm12, %xmm10
	vaddss	%xmm10, %xmm8, %xmm8
	vmulss	%xmm5, %xmm13, %xmm10
	vmulss	%xmm5, %xmm4, %xmm5
	vsubss	%xmm10, %xmm15, %xmm11
	vaddss	%xmm10, %xmm15, %xmm10
	vbroadcastss	%xmm10, %zmm10
	vbroadcastss	%xmm11, %zmm11
	vmovups	%zmm10, 3328(%rsp)
	vmulss	%xmm7, %xmm13, %xmm10
	vmovups	%zmm11, 3392(%rsp)
	vsubss	%xmm10, %xmm18, %xmm11
	vaddss	%xmm10, %xmm18, %xmm10
	vmovss	152(%rsp), %xmm18
	vbroadcastss	%xmm10, %zmm10
	vbroadcastss	%xmm11, %zmm11
	vmovups	%zmm10, 3200(%rsp)
	vmulss	%xmm13, %xmm8, %xmm10
	vmovups	%zmm11, 3264(%rsp)
	vsubss	%xmm10, %xmm19, %xmm11
	vaddss	%xmm10, %xmm19, %xmm10
	vbroadcastss	%xmm10, %zmm10
	vbroadcastss	%xmm11, %zmm11
	vmovups	%zmm10, 3072(%rsp)
	vandps	%xmm2, %xmm12, %xmm10
	vmovups	%zmm11, 3136(%rsp)
	vaddss	%xmm5, %xmm10, %xmm5
	vmulss	%xmm18, %xmm5, %xmm5
	vsubss	%xmm5, %xmm2, %xmm10
	vaddss	%xmm5, %xmm2, %xmm2
	vmulss	%xmm7, %xmm4, %xmm5
	vbroadcastss	%xmm2, %zmm13
	vandps	%xmm3, %xmm12, %xmm2
	vbroadcastss	%xmm10, %zmm10
	vaddss	%xmm2, %xmm5, %xmm2
	vmovups	%zmm10, 1152(%rsp)
	vmovups	%zmm13, 1088(%rsp)
	vmulss	%xmm18, %xmm2, %xmm2
	vsubss	%xmm2, %xmm3, %xmm5
	vaddss	%xmm2, %xmm3, %xmm2
	vmulss	%xmm4, %xmm8, %xmm3
	vbroadcastss	%xmm2, %zmm15
	vandps	%xmm1, %xmm12, %xmm2
	vbroadcastss	%xmm5, %zmm7
	vaddss	%xmm2, %xmm3, %xmm2
	vmovups	%zmm7, 1024(%rsp)
	vmovups	%zmm15, 2304(%rsp)
	vmulss	%xmm18, %xmm2, %xmm2
	vsubss	%xmm2, %xmm1, %xmm3
	vaddss	%xmm2, %xmm1, %xmm1
	vbroadcastss	%xmm1, %zmm8
	vsubss	%xmm6, %xmm4, %xmm1
	vbroadcastss	%xmm3, %zmm12
	vmovdqa64	%zmm14, %zmm6
	vmovups	%zmm12, 320(%rsp)
	vmovups	%zmm8, 2240(%rsp)
	vbroadcastss	%xmm1, %zmm18
	vmovups	%zmm18, 704(%rsp)
	jmp	.LBB0_9
	.p2align	4
.LBB0_89:
	vmovdqu64	1792(%rsp), %zmm8
	vmovdqu64	1728(%rsp), %zmm10
	vmovups	3520(%rsp), %zmm4
	kmovw	80(%rsp), %k2
	vmovdqu64	3904(%rsp), %zmm14
	vmovdqu64	3840(%rsp), %zmm20
	knotw	%k2, %k0
	vmovdqa32	%zmm28, %zmm13 {%k2}
	vmovups	3776(%rsp), %zmm5 {%k2}
	vpmovm2d	%k0, %zmm1
	kmovw	448(%rsp), %k0
	vpsrld	$31, %zmm1, %zmm1
	vpaddd	%zmm8, %zmm8, %zmm2
	vpaddd	3584(%rsp), %zmm2, %zmm2
	vpaddd	%zmm10, %zmm10, %zmm3
	vpcmpgtd	%zmm14, %zmm20, %k1
	vpternlogq	$15, %zmm3, %zmm3, %zmm3
	vpaddd	%zmm3, %zmm26, %zmm3
	vcvtdq2ps	%zmm3, %zmm3
	korw	%k0, %k2, %k0
	kmovw	72(%rsp), %k2
	vdivps	%zmm4, %zmm3, %zmm3
	vcvtdq2ps	%zmm2, %zmm2
	kandw	%k2, %k0, %k2
	kmovq	%k2, %k3
	vmulps	640(%rsp), %zmm3, %zmm7
	vmulps	576(%rsp), %zmm3, %zmm11
	vmulps	512(%rsp), %zmm3, %zmm3
	vdivps	%zmm4, %zmm2, %zmm2
	vmulps	960(%rsp), %zmm2, %zmm4
	vmulps	896(%rsp), %zmm2, %zmm6
	vmulps	832(%rsp), %zmm2, %zmm2
	vaddps	1664(%rsp), %zmm4, %zmm4
	vaddps	1600(%rsp), %zmm6, %zmm6
	vaddps	1536(%rsp), %zmm2, %zmm2
	vaddps	%zmm4, %zmm7, %zmm4
	vaddps	%zmm6, %zmm11, %zmm6
	vaddps	%zmm2, %zmm3, %zmm2
	vpmulld	%zmm26, %zmm10, %zmm3
	vmulps	%zmm4, %zmm4, %zmm4
	vmulps	%zmm6, %zmm6, %zmm6
	vmulps	%zmm2, %zmm2, %zmm2
	vpaddd	%zmm8, %zmm3, %zmm3
	vaddps	%zmm6, %zmm4, %zmm4
	vaddps	%zmm4, %zmm2, %zmm2
	vpslld	$7, %zmm13, %zmm4
	vpaddd	%zmm9, %zmm4, %zmm4
	vpord	%zmm1, %zmm4, %zmm1
	vsqrtps	%zmm2, %zmm2 {%k2} {z}
	vmulps	%zmm2, %zmm5, %zmm2
	vscatterdps	%zmm2, (%r9,%zmm3,4) {%k3}
	vpscatterdd	%zmm1, (%r10,%zmm3,4) {%k2}
	vmovdqu64	2176(%rsp), %zmm6
	vmovups	384(%rsp), %zmm28
	vmovups	320(%rsp), %zmm12
	vmovups	704(%rsp), %zmm18
	kmovw	96(%rsp), %k2
	vpaddd	3456(%rsp), %zmm6, %zmm6
	vpcmpgtd	%zmm6, %zmm20, %k2 {%k2}
	ktestw	%k1, %k2
	je	.LBB0_91
.LBB0_9:
	cmpl	$0, 68(%rsp)
	vpcmpgtd	%zmm14, %zmm20, %k1 {%k2}
	kmovw	%k2, 96(%rsp)
	js	.LBB0_11
	vpsrad	$2, %zmm6, %zmm1
	kmovw	102(%rsp), %k0
	movabsq	$.LCPI0_12, %rax
	movabsq	$.LCPI0_13, %rcx
	vxorps	%xmm3, %xmm3, %xmm3
	vpxord	%xmm25, %xmm25, %xmm25
	vpaddd	%zmm1, %zmm1, %zmm2
	vpaddd	3008(%rsp), %zmm1, %zmm1
	vpandd	(%rax){1to16}, %zmm6, %zmm7
	movq	136(%rsp), %rax
	vpbroadcastd	(%rcx), %zmm5
	movabsq	$.LCPI0_16, %rcx
	kandw	%k0, %k1, %k2
	kmovq	%k2, %k3
	vpaddd	%zmm2, %zmm1, %zmm1
	vpgatherdd	(%rax,%zmm1,4), %zmm3 {%k3}
	kmovq	%k2, %k3
	vpgatherdd	4(%rax,%zmm1,4), %zmm25 {%k3}
	vpaddd	%zmm3, %zmm3, %zmm4
	vpsrld	$15, %zmm3, %zmm3
	vpandd	%zmm5, %zmm4, %zmm11
	vpsrld	$1, %zmm7, %zmm4
	vpternlogd	$248, (%r15){1to16}, %zmm6, %zmm11
	vpternlogd	$248, %zmm5, %zmm3, %zmm4
	vpxor	%xmm3, %xmm3, %xmm3
	vpgatherdd	8(%rax,%zmm1,4), %zmm3 {%k2}
	vpaddd	%zmm7, %zmm3, %zmm1
	vpsrad	$2, %zmm1, %zmm3
	jmp	.LBB0_12
	.p2align	4
.LBB0_11:
	vpbroadcastd	(%rax), %zmm1
	vpbroadcastd	(%r13), %zmm4
	vpbroadcastd	(%rsi), %zmm5
	movabsq	$.LCPI0_11, %rax
	vpsrld	$1, %zmm6, %zmm7
	vpbroadcastd	(%r15), %zmm25
	vpandd	%zmm1, %zmm6, %zmm2
	vpandd	%zmm1, %zmm7, %zmm1
	vpsrld	$1, %zmm2, %zmm3
	vpternlogd	$200, %zmm2, %zmm4, %zmm3
	vpsrld	$2, %zmm3, %zmm2
	vpternlogd	$200, %zmm3, %zmm5, %zmm2
	vpsrld	$4, %zmm2, %zmm3
	vpord	%zmm2, %zmm3, %zmm2
	vmovdqu64	(%rax), %zmm3
	vpshufb	%zmm3, %zmm2, %zmm11
	vpsrld	$1, %zmm1, %zmm2
	vpternlogd	$200, %zmm1, %zmm4, %zmm2
	vpsrld	$2, %zmm2, %zmm1
	vpternlogd	$200, %zmm2, %zmm5, %zmm1
	vpsrld	$4, %zmm1, %zmm2
	vpord	%zmm1, %zmm2, %zmm1
	vpshufb	%zmm3, %zmm1, %zmm4
	vpxor	%xmm3, %xmm3, %xmm3
.LBB0_12:
	vpmaxsd	%zmm11, %zmm4, %zmm1 {%k1} {z}
	vmovdqu64	%zmm6, 2176(%rsp)
	vmovdqu64	%zmm11, 1792(%rsp)
	vmovdqu64	%zmm4, 1728(%rsp)
	vpsllvd	%zmm24, %zmm1, %zmm1
	vpcmpgtd	%zmm1, %zmm26, %k7
	kandw	%k7, %k1, %k2
	kortestw	%k2, %k2
	je	.LBB0_13
	vmovdqu64	2816(%rsp), %zmm6
	vpsllvd	%zmm24, %zmm11, %zmm5
	vpsllvd	%zmm24, %zmm4, %zmm7
	vmovdqu64	%zmm3, 2048(%rsp)
	movabsq	$.LCPI0_14, %rax
	vmovdqa32	%zmm26, %zmm2 {%k2} {z}
	vmovups	640(%rsp), %zmm10
	movq	%r11, %rsi
	movq	%r12, %r11
	movq	%rdi, %r12
	movabsq	$.LCPI0_18, %rdi
	vpxor	%xmm14, %xmm14, %xmm14
	kmovw	%k2, 80(%rsp)
	vmovdqu64	%zmm5, 2112(%rsp)
	vcvtdq2ps	%zmm5, %zmm4
	vmovdqu64	%zmm7, 768(%rsp)
	vpaddd	%zmm6, %zmm5, %zmm1
	vpaddd	%zmm6, %zmm7, %zmm3
	vmovups	2752(%rsp), %zmm6
	vbroadcastss	(%rax), %zmm5
	movabsq	$.LCPI0_15, %rax
	vmovdqu64	%zmm1, 1984(%rsp)
	vmovdqa32	%zmm1, %zmm1 {%k2} {z}
	vpminsd	%zmm2, %zmm1, %zmm1
	vmovdqu64	%zmm3, 1920(%rsp)
	vmovdqa32	%zmm3, %zmm3 {%k2} {z}
	vpminsd	%zmm2, %zmm3, %zmm2
	vbroadcastss	(%rax), %zmm8
	movabsq	$.LCPI0_7, %rax
	vcvtdq2ps	%zmm1, %zmm1
	vcvtdq2ps	%zmm2, %zmm2
	vmulps	%zmm1, %zmm6, %zmm1
	vmulps	%zmm4, %zmm6, %zmm4
	vmulps	%zmm2, %zmm6, %zmm2
	vmovups	%zmm5, 256(%rsp)
	vaddps	%zmm5, %zmm4, %zmm3
	vaddps	%zmm5, %zmm1, %zmm1
	vcvtdq2ps	%zmm7, %zmm5
	vsubps	%zmm2, %zmm8, %zmm2
	vmulps	%zmm5, %zmm6, %zmm5
	vmovups	960(%rsp), %zmm6
	vsubps	%zmm5, %zmm8, %zmm4
	vmulps	%zmm2, %zmm10, %zmm8
	vmulps	%zmm4, %zmm10, %zmm10
	vmovdqa32	%zmm8, %zmm8 {%k2} {z}
	vmulps	%zmm3, %zmm6, %zmm5
	vmulps	%zmm1, %zmm6, %zmm6
	vmovdqa32	%zmm10, %zmm10 {%k2} {z}
	vmovdqa32	%zmm5, %zmm5 {%k2} {z}
	vmovdqa32	%zmm6, %zmm6 {%k2} {z}
	vcmpltps	%zmm6, %zmm5, %k1
	vpblendmd	%zmm5, %zmm6, %zmm7 {%k1}
	vcmpltps	%zmm10, %zmm8, %k1
	vaddps	3392(%rsp), %zmm7, %zmm7
	vpblendmd	%zmm8, %zmm10, %zmm11 {%k1}
	vcmpltps	%zmm5, %zmm6, %k1
	vmovdqa32	%zmm5, %zmm6 {%k1}
	vaddps	3328(%rsp), %zmm6, %zmm5
	vmovups	896(%rsp), %zmm6
	vcmpltps	%zmm8, %zmm10, %k1
	vmovdqa32	%zmm8, %zmm10 {%k1}
	vaddps	%zmm11, %zmm7, %zmm7
	vmovups	576(%rsp), %zmm11
	vmovups	%zmm7, 2432(%rsp)
	vaddps	%zmm10, %zmm5, %zmm5
	vmovups	%zmm5, 1856(%rsp)
	vmulps	%zmm3, %zmm6, %zmm5
	vmulps	%zmm1, %zmm6, %zmm6
	vmulps	%zmm2, %zmm11, %zmm8
	vmulps	%zmm4, %zmm11, %zmm10
	vmovdqa32	%zmm5, %zmm5 {%k2} {z}
	vmovdqa32	%zmm6, %zmm6 {%k2} {z}
	vcmpltps	%zmm6, %zmm5, %k1
	vmovdqa32	%zmm8, %zmm8 {%k2} {z}
	vmovdqa32	%zmm10, %zmm10 {%k2} {z}
	vpblendmd	%zmm5, %zmm6, %zmm7 {%k1}
	vcmpltps	%zmm10, %zmm8, %k1
	vaddps	3264(%rsp), %zmm7, %zmm7
	vpblendmd	%zmm8, %zmm10, %zmm11 {%k1}
	vcmpltps	%zmm5, %zmm6, %k1
	vmovdqa32	%zmm5, %zmm6 {%k1}
	vaddps	3200(%rsp), %zmm6, %zmm5
	vmovups	832(%rsp), %zmm6
	vcmpltps	%zmm8, %zmm10, %k1
	vmovdqa32	%zmm8, %zmm10 {%k1}
	vaddps	%zmm11, %zmm7, %zmm7
	vmulps	%zmm3, %zmm6, %zmm3
	vmulps	%zmm1, %zmm6, %zmm1
	vmovups	512(%rsp), %zmm6
	vmovups	%zmm7, 1408(%rsp)
	vaddps	%zmm10, %zmm5, %zmm5
	vmovdqa32	%zmm3, %zmm3 {%k2} {z}
	vmovdqa32	%zmm1, %zmm1 {%k2} {z}
	vcmpltps	%zmm1, %zmm3, %k1
	vmovups	%zmm5, 2368(%rsp)
	vpblendmd	%zmm3, %zmm1, %zmm5 {%k1}
	vaddps	3136(%rsp), %zmm5, %zmm5
	vmulps	%zmm2, %zmm6, %zmm2
	vmulps	%zmm4, %zmm6, %zmm4
	vmovdqa32	%zmm2, %zmm2 {%k2} {z}
	vmovdqa32	%zmm4, %zmm4 {%k2} {z}
	vcmpltps	%zmm4, %zmm2, %k1
	vpblendmd	%zmm2, %zmm4, %zmm6 {%k1}
	vcmpltps	%zmm3, %zmm1, %k1
	vmovdqa32	%zmm3, %zmm1 {%k1}
	vcmpltps	%zmm2, %zmm4, %k1
	vaddps	3072(%rsp), %zmm1, %zmm1
	vaddps	%zmm6, %zmm5, %zmm5
	vmovdqa32	%zmm2, %zmm4 {%k1}
	vpbroadcastd	(%r15), %zmm2
	movq	%r8, %r15
	movq	%rbx, %r8
	movabsq	$.LCPI0_25, %rbx
	vmovups	%zmm5, 1344(%rsp)
	vpcmpneqd	%zmm2, %zmm25, %k1
	vaddps	%zmm4, %zmm1, %zmm1
	vmovdqu64	%zmm2, 1216(%rsp)
	vmovdqa32	%zmm27, %zmm27 {%k1} {z}
	vpandd	(%rcx){1to16}, %zmm27, %zmm3
	vmovups	%zmm1, 1280(%rsp)
	vpsllvd	%zmm3, %zmm2, %zmm1
	vcvtdq2ps	%zmm1, %zmm1
	vdivps	%zmm1, %zmm18, %zmm23
	.p2align	4
.LBB0_15:
	vmovups	704(%rsp), %zmm3
	vpsubd	%zmm0, %zmm25, %zmm20
	vcvtdq2ps	%zmm25, %zmm1
	vmovups	1856(%rsp), %zmm7
	vmovups	1408(%rsp), %zmm8
	kandw	%k7, %k2, %k5
	movabsq	$.LCPI0_17, %r14
	vmovups	2368(%rsp), %zmm10
	vmovups	%zmm18, 448(%rsp)
	vmovups	1344(%rsp), %zmm15
	vmovups	1280(%rsp), %zmm5
	vmovdqa32	%zmm25, %zmm13 {%k7}
	vcvtdq2ps	%zmm20, %zmm2
	vpbroadcastd	(%r15), %zmm18 {%k5} {z}
	vmulps	%zmm1, %zmm23, %zmm1
	vmulps	%zmm2, %zmm23, %zmm2
	vsubps	%zmm3, %zmm1, %zmm1
	vsubps	%zmm3, %zmm2, %zmm2
	vmovups	2432(%rsp), %zmm3
	vaddps	%zmm1, %zmm28, %zmm6
	vaddps	%zmm2, %zmm28, %zmm19
	vmovaps	%zmm6, %zmm29 {%k7}
	vmulps	%zmm6, %zmm3, %zmm1
	vmulps	%zmm19, %zmm3, %zmm2
	vmulps	%zmm6, %zmm7, %zmm3
	vmulps	%zmm19, %zmm7, %zmm7
	vmovdqa32	%zmm1, %zmm1 {%k5} {z}
	vmovdqa32	%zmm2, %zmm2 {%k5} {z}
	vcmpltps	%zmm2, %zmm1, %k1
	vmovdqa32	%zmm3, %zmm3 {%k5} {z}
	vmovdqa32	%zmm7, %zmm7 {%k5} {z}
	vcmpltps	%zmm3, %zmm7, %k2
	vmovdqa32	%zmm1, %zmm2 {%k1}
	vaddps	1152(%rsp), %zmm2, %zmm2
	vpbroadcastd	(%r14), %zmm1 {%k5} {z}
	vmovdqa32	%zmm3, %zmm7 {%k2}
	vaddps	1088(%rsp), %zmm7, %zmm3
	vmulps	%zmm6, %zmm8, %zmm7
	vmulps	%zmm19, %zmm8, %zmm8
	movabsq	$.LCPI0_20, %r14
	vbroadcastss	(%r14), %zmm21
	movabsq	$.LCPI0_21, %r14
	vmovdqa32	%zmm7, %zmm7 {%k5} {z}
	vmovdqa32	%zmm8, %zmm8 {%k5} {z}
	vcmpltps	%zmm8, %zmm7, %k6
	vmovdqa32	%zmm7, %zmm8 {%k6}
	vaddps	1024(%rsp), %zmm8, %zmm7
	vmulps	%zmm6, %zmm10, %zmm8
	vmulps	%zmm19, %zmm10, %zmm10
	vmovdqa32	%zmm8, %zmm8 {%k5} {z}
	vmovdqa32	%zmm10, %zmm10 {%k5} {z}
	vmovdqa32	%zmm2, %zmm2 {%k5} {z}
	vcmpltps	%zmm2, %zmm1, %k1
	vmovdqa32	%zmm3, %zmm3 {%k5} {z}
	vcmpltps	%zmm18, %zmm3, %k2
	vpblendmd	%zmm2, %zmm1, %zmm2 {%k1}
	vcmpltps	%zmm8, %zmm10, %k1
	vpblendmd	%zmm3, %zmm18, %zmm11 {%k2}
	vmulps	%zmm6, %zmm15, %zmm3
	vmovdqa32	%zmm8, %zmm10 {%k1}
	vaddps	2304(%rsp), %zmm10, %zmm8
	vmulps	%zmm19, %zmm15, %zmm10
	vmovdqa32	%zmm3, %zmm3 {%k5} {z}
	vmovdqa32	%zmm7, %zmm7 {%k5} {z}
	vcmpltps	%zmm7, %zmm1, %k6
	vmovdqa32	%zmm10, %zmm10 {%k5} {z}
	vcmpltps	%zmm10, %zmm3, %k2
	vpblendmd	%zmm7, %zmm1, %zmm15 {%k6}
	vmovdqa32	%zmm3, %zmm10 {%k2}
	vaddps	%zmm10, %zmm12, %zmm3
	vmulps	%zmm6, %zmm5, %zmm10
	vmovdqa32	%zmm3, %zmm7 {%k5} {z}
	vcmpltps	%zmm7, %zmm1, %k2
	vmovdqa32	%zmm10, %zmm10 {%k5} {z}
	vmovdqa32	%zmm8, %zmm8 {%k5} {z}
	vcmpltps	%zmm18, %zmm8, %k1
	vmovdqa32	%zmm7, %zmm1 {%k2}
	vcmpltps	%zmm2, %zmm11, %k2
	vpblendmd	%zmm8, %zmm18, %zmm3 {%k1}
	vmulps	%zmm19, %zmm5, %zmm8
	vcmpltps	%zmm15, %zmm3, %k6
	vsubps	%zmm3, %zmm16, %zmm5
	vmovdqa32	%zmm8, %zmm8 {%k5} {z}
	vcmpltps	%zmm10, %zmm8, %k1
	vmovdqa32	%zmm10, %zmm8 {%k1}
	vaddps	2240(%rsp), %zmm8, %zmm7
	vmovdqa32	%zmm7, %zmm7 {%k5} {z}
	vcmpltps	%zmm18, %zmm7, %k1
	vmovdqa32	%zmm7, %zmm18 {%k1}
	korw	%k6, %k2, %k1
	vcmpltps	%zmm1, %zmm18, %k2
	vsubps	%zmm11, %zmm16, %zmm7
	vsubps	%zmm1, %zmm18, %zmm22
	korw	%k2, %k1, %k0
	kandnw	%k5, %k0, %k1
	kandw	%k0, %k5, %k0
	vmovdqa32	%zmm2, %zmm8 {%k1} {z}
	vmovdqa32	%zmm7, %zmm7 {%k1} {z}
	vcmpltps	%zmm8, %zmm7, %k2
	vmovdqa32	%zmm15, %zmm10 {%k1} {z}
	vmovdqa32	%zmm1, %zmm12 {%k1} {z}
	vmovdqa32	%zmm8, %zmm7 {%k2}
	vmovdqa32	%zmm5, %zmm8 {%k1} {z}
	vcmpltps	%zmm10, %zmm8, %k2
	vsubps	%zmm18, %zmm16, %zmm5
	vmaxps	%zmm16, %zmm7, %zmm7
	vmovdqa32	%zmm10, %zmm8 {%k2}
	vmaxps	%zmm16, %zmm8, %zmm8
	vmulps	%zmm7, %zmm7, %zmm7
	vmovdqa32	%zmm5, %zmm10 {%k1} {z}
	vcmpltps	%zmm12, %zmm10, %k2
	vmulps	%zmm8, %zmm8, %zmm8
	vmovdqa32	%zmm12, %zmm10 {%k2}
	vmaxps	%zmm16, %zmm10, %zmm10
	vsubps	%zmm15, %zmm3, %zmm12
	vaddps	%zmm8, %zmm7, %zmm7
	vmulps	%zmm10, %zmm10, %zmm8
	vpbroadcastd	(%rdx), %zmm10
	vpaddd	%zmm12, %zmm12, %zmm12
	vaddps	%zmm8, %zmm7, %zmm7
	vsubps	%zmm2, %zmm11, %zmm8
	vcmpngtps	(%rdi){1to16}, %zmm7, %k6 {%k1}
	vpaddd	%zmm8, %zmm8, %zmm8
	vcmpgtps	(%rdi){1to16}, %zmm7, %k1 {%k1}
	vmovdqu64	1216(%rsp), %zmm7
	vpcmpnltud	%zmm10, %zmm8, %k2 {%k6}
	vbroadcastss	(%r14), %zmm8
	movabsq	$.LCPI0_22, %r14
	korw	%k1, %k0, %k0
	vbroadcastss	(%r14), %zmm28
	vmovaps	%zmm21, %zmm2 {%k2}
	movabsq	$.LCPI0_10, %r14
	vmovaps	%zmm8, %zmm11 {%k2}
	vxorps	%zmm28, %zmm11, %zmm5 {%k6} {z}
	vpcmpnltud	%zmm10, %zmm12, %k2 {%k6}
	vpaddd	%zmm22, %zmm22, %zmm12
	vmovdqa32	%zmm2, %zmm22 {%k6} {z}
	vxorps	%zmm28, %zmm2, %zmm2 {%k6} {z}
	vmovdqa32	%zmm11, %zmm11 {%k6} {z}
	vcmpltps	%zmm22, %zmm5, %k4
	vmovaps	%zmm21, %zmm15 {%k2}
	vmovaps	%zmm8, %zmm3 {%k2}
	vpcmpnltud	%zmm10, %zmm12, %k2 {%k6}
	vbroadcastss	(%r12), %zmm12
	vmovaps	%zmm8, %zmm18 {%k2}
	vmovaps	%zmm21, %zmm1 {%k2}
	vmovdqa32	%zmm22, %zmm5 {%k4}
	vmaxps	%zmm16, %zmm5, %zmm22
	vcmpltps	%zmm2, %zmm11, %k4
	vxorps	%zmm28, %zmm3, %zmm5 {%k6} {z}
	vmovdqa32	%zmm3, %zmm3 {%k6} {z}
	vmulps	%zmm22, %zmm22, %zmm26
	vbroadcastss	(%rsi), %zmm22
	vmovdqa32	%zmm2, %zmm11 {%k4}
	vmulps	%zmm11, %zmm11, %zmm2
	vandps	%zmm22, %zmm2, %zmm24
	vandps	%zmm22, %zmm26, %zmm11
	vmulps	%zmm12, %zmm24, %zmm24 {%k6} {z}
	vmulps	%zmm12, %zmm11, %zmm11
	vaddps	%zmm24, %zmm2, %zmm24
	vmovdqa32	%zmm15, %zmm2 {%k6} {z}
	vcmpltps	%zmm2, %zmm5, %k4
	vxorps	%zmm28, %zmm15, %zmm15 {%k6} {z}
	vsubps	%zmm11, %zmm26, %zmm26 {%k6}
	vbroadcastss	(%r11), %zmm11
	vmovdqa32	%zmm2, %zmm5 {%k4}
	vbroadcastss	(%rbx), %zmm2
	vmaxps	%zmm16, %zmm5, %zmm5
	vcmpltps	%zmm15, %zmm3, %k4
	vmulps	%zmm5, %zmm5, %zmm5
	vmovdqa32	%zmm15, %zmm3 {%k4}
	vmulps	%zmm3, %zmm3, %zmm3
	vaddps	%zmm11, %zmm26, %zmm26
	vaddps	%zmm2, %zmm24, %zmm15
	vandps	%zmm22, %zmm5, %zmm24
	vmulps	%zmm12, %zmm24, %zmm24
	vsubps	%zmm24, %zmm5, %zmm5 {%k6}
	vandps	%zmm22, %zmm3, %zmm24
	vmulps	%zmm12, %zmm24, %zmm24 {%k6} {z}
	vaddps	%zmm11, %zmm5, %zmm5
	vaddps	%zmm24, %zmm3, %zmm3
	vsubps	%zmm26, %zmm15, %zmm24
	vaddps	%zmm2, %zmm3, %zmm3
	vpaddd	%zmm24, %zmm24, %zmm24
	vpcmpnltud	%zmm10, %zmm24, %k4 {%k6}
	vmovaps	%zmm21, %zmm26 {%k4}
	vmovaps	%zmm8, %zmm15 {%k4}
	vsubps	%zmm5, %zmm3, %zmm24
	vpaddd	%zmm24, %zmm24, %zmm24
	vpcmpnltud	%zmm10, %zmm24, %k3 {%k6}
	vmovaps	%zmm21, %zmm5 {%k3}
	vaddps	%zmm5, %zmm26, %zmm5
	vmovaps	%zmm8, %zmm3 {%k3}
	vaddps	%zmm3, %zmm15, %zmm3
	vmovdqa32	%zmm1, %zmm26 {%k6} {z}
	vxorps	%zmm28, %zmm1, %zmm1 {%k6} {z}
	vandps	%zmm22, %zmm5, %zmm15
	vandps	%zmm22, %zmm3, %zmm24
	vmulps	%zmm12, %zmm15, %zmm15
	vsubps	%zmm15, %zmm5, %zmm5 {%k6}
	vmulps	%zmm12, %zmm24, %zmm15 {%k6} {z}
	vxorps	%zmm28, %zmm18, %zmm24 {%k6} {z}
	vmovdqa32	%zmm18, %zmm18 {%k6} {z}
	vmovups	384(%rsp), %zmm28
	vcmpltps	%zmm26, %zmm24, %k2
	vaddps	%zmm3, %zmm15, %zmm3
	vmovdqa32	%zmm26, %zmm24 {%k2}
	vmaxps	%zmm16, %zmm24, %zmm15
	vcmpltps	%zmm1, %zmm18, %k2
	vaddps	%zmm11, %zmm5, %zmm5
	vmulps	%zmm15, %zmm15, %zmm24
	vmovdqa32	%zmm1, %zmm18 {%k2}
	vmulps	%zmm18, %zmm18, %zmm15
	vaddps	%zmm2, %zmm3, %zmm3
	vandps	%zmm22, %zmm24, %zmm18
	vmulps	%zmm12, %zmm18, %zmm18
	vsubps	%zmm18, %zmm24, %zmm24 {%k6}
	vandps	%zmm22, %zmm15, %zmm18
	vmulps	%zmm12, %zmm18, %zmm18 {%k6} {z}
	vaddps	%zmm11, %zmm24, %zmm1
	vaddps	%zmm18, %zmm15, %zmm15
	vsubps	%zmm5, %zmm3, %zmm18
	vaddps	%zmm2, %zmm15, %zmm15
	vpaddd	%zmm18, %zmm18, %zmm18
	vpcmpnltud	%zmm10, %zmm18, %k2 {%k6}
	vmovaps	%zmm21, %zmm5 {%k2}
	vmovaps	%zmm8, %zmm3 {%k2}
	vsubps	%zmm1, %zmm15, %zmm18
	vpaddd	%zmm18, %zmm18, %zmm18
	vpcmpnltud	%zmm10, %zmm18, %k3 {%k6}
	vmovups	448(%rsp), %zmm18
	vmovaps	%zmm21, %zmm1 {%k3}
	vaddps	%zmm1, %zmm5, %zmm1
	vmovaps	%zmm8, %zmm15 {%k3}
	vaddps	%zmm15, %zmm3, %zmm3
	vmovups	256(%rsp), %zmm15
	knotw	%k6, %k3
	vandps	%zmm22, %zmm1, %zmm5
	vandps	%zmm22, %zmm3, %zmm24
	vmulps	%zmm12, %zmm5, %zmm5
	vsubps	%zmm5, %zmm1, %zmm1 {%k6}
	vmulps	%zmm12, %zmm24, %zmm5 {%k6} {z}
	vmovaps	%zmm19, %zmm18 {%k7}
	vaddps	%zmm3, %zmm5, %zmm3
	vaddps	%zmm11, %zmm1, %zmm1
	vaddps	%zmm2, %zmm3, %zmm3
	vsubps	%zmm1, %zmm3, %zmm5
	vaddps	%zmm15, %zmm1, %zmm1
	vaddps	%zmm15, %zmm3, %zmm3
	vpaddd	%zmm5, %zmm5, %zmm5
	vpcmpnltud	%zmm10, %zmm5, %k2 {%k6}
	vmovaps	%zmm21, %zmm1 {%k2}
	vandps	%zmm22, %zmm1, %zmm5
	vmovaps	%zmm8, %zmm3 {%k2}
	vandps	%zmm22, %zmm3, %zmm10
	vmulps	%zmm12, %zmm5, %zmm5
	vsubps	%zmm5, %zmm1, %zmm1 {%k6}
	vmulps	%zmm12, %zmm10, %zmm5 {%k6} {z}
	vmovups	320(%rsp), %zmm12
	vaddps	%zmm3, %zmm5, %zmm3
	vaddps	%zmm11, %zmm1, %zmm1
	vaddps	%zmm2, %zmm3, %zmm2
	vsubps	%zmm1, %zmm2, %zmm3
	vcmpltps	%zmm16, %zmm2, %k4
	vandps	%zmm22, %zmm3, %zmm3
	vcmpneq_oqps	%zmm8, %zmm3, %k2
	vpbroadcastd	(%r13), %zmm3
	korw	%k2, %k3, %k2
	vcmpltps	%zmm1, %zmm16, %k3
	vpandnd	%zmm20, %zmm25, %zmm1
	vpaddd	%zmm25, %zmm25, %zmm25
	korw	%k4, %k3, %k1
	kandw	%k1, %k2, %k2
	kandw	%k2, %k6, %k1
	kandnw	%k6, %k2, %k2
	vpcmpled	1472(%rsp), %zmm27, %k2 {%k2}
	korw	%k1, %k0, %k1
	vpaddd	%zmm0, %zmm1, %zmm1 {%k1} {z}
	vpsrld	$1, %zmm1, %zmm2
	vpandd	(%rax){1to16}, %zmm2, %zmm2
	vpsubd	%zmm2, %zmm1, %zmm1
	vpsrld	$2, %zmm1, %zmm2
	vpandd	%zmm3, %zmm1, %zmm1
	vpandd	%zmm3, %zmm2, %zmm2
	vpbroadcastd	(%rcx), %zmm3
	vpaddd	%zmm1, %zmm2, %zmm1
	vpsrld	$4, %zmm1, %zmm2
	vpaddd	%zmm1, %zmm2, %zmm1
	vpandd	(%r14){1to16}, %zmm1, %zmm1
	movabsq	$.LCPI0_26, %r14
	vpsrld	$8, %zmm1, %zmm2
	vpaddd	%zmm1, %zmm2, %zmm1
	vpsrld	$16, %zmm1, %zmm2
	vpandd	%zmm3, %zmm2, %zmm2
	vpaddd	%zmm1, %zmm2, %zmm1
	vpandd	(%r14){1to16}, %zmm1, %zmm2
	movabsq	$.LCPI0_28, %r14
	vpandd	%zmm3, %zmm1, %zmm1
	vmovdqa64	%zmm7, %zmm3
	vpsravd	%zmm1, %zmm20, %zmm5
	vpsllvd	%zmm1, %zmm7, %zmm1
	vpcmpeqd	%zmm7, %zmm5, %k3 {%k1}
	vpcmpneqd	%zmm7, %zmm5, %k0 {%k1}
	vmovdqa32	%zmm5, %zmm25 {%k1}
	korw	%k2, %k0, %k0
	vpsubd	%zmm2, %zmm16, %zmm3 {%k1}
	vpblendmd	(%r14){1to16}, %zmm7, %zmm2 {%k3}
	kmovw	80(%rsp), %k2
	vpaddd	%zmm3, %zmm27, %zmm27
	vbroadcastss	(%r8), %zmm3
	vcvtdq2ps	%zmm1, %zmm3 {%k1}
	vmulps	%zmm3, %zmm23, %zmm23
	vpsubd	%zmm0, %zmm14, %zmm3
	vmovdqa32	%zmm3, %zmm14 {%k6}
	vmovdqa32	%zmm14, %zmm30 {%k7}
	vpblendmd	%zmm14, %zmm3, %zmm14 {%k1}
	knotw	%k0, %k1
	vmovdqa32	%zmm3, %zmm31 {%k7}
	vmovdqa32	%zmm2, %zmm1 {%k1} {z}
	vmovdqa32	%zmm1, %zmm4 {%k7}
	kandw	%k0, %k7, %k7
	ktestw	%k2, %k7
	jne	.LBB0_15
	movabsq	$.LCPI0_28, %rax
	vmovdqu64	2944(%rsp), %zmm24
	vmovdqu64	2880(%rsp), %zmm26
	vmovdqu64	1472(%rsp), %zmm27
	vmovdqu64	1792(%rsp), %zmm11
	vmovdqu64	2112(%rsp), %zmm6
	vmovups	768(%rsp), %zmm8
	vmovdqu64	2048(%rsp), %zmm3
	vmovdqu64	1984(%rsp), %zmm7
	vmovups	1920(%rsp), %zmm10
	movq	%r12, %rdi
	movq	%r11, %r12
	movq	%r8, %rbx
	movq	%r15, %r8
	movq	%rsi, %r11
	movl	$1, %r14d
	movabsq	$.LCPI0_8, %r15
	movabsq	$.LCPI0_10, %rsi
	vpbroadcastd	(%rax), %zmm1
	vpcmpeqd	%zmm1, %zmm4, %k5
	vpcmpneqd	%zmm1, %zmm4, %k1
	vmovdqu64	1728(%rsp), %zmm4
	jmp	.LBB0_17
	.p2align	4
.LBB0_13:
	vpxor	%xmm6, %xmm6, %xmm6
	kxorw	%k0, %k0, %k5
	vxorps	%xmm29, %xmm29, %xmm29
	vxorps	%xmm8, %xmm8, %xmm8
	vpxor	%xmm7, %xmm7, %xmm7
	vxorps	%xmm10, %xmm10, %xmm10
	vpxord	%xmm30, %xmm30, %xmm30
	vxorps	%xmm18, %xmm18, %xmm18
	vpxord	%xmm31, %xmm31, %xmm31
	vxorps	%xmm13, %xmm13, %xmm13
	kxorw	%k0, %k0, %k1
.LBB0_17:
	vmovdqu64	3648(%rsp), %zmm25
	kmovw	72(%rsp), %k0
	movq	88(%rsp), %rdx
	movq	56(%rsp), %r13
	kandw	%k1, %k2, %k1
	kmovw	%k1, 448(%rsp)
	kandnw	%k1, %k0, %k6
	kmovd	%k6, %eax
	testb	$1, %al
	je	.LBB0_19
	movl	$1, %eax
	lock		xaddl	%eax, (%rdx,%r13,4)
	vmovd	%eax, %xmm2
.LBB0_19:
	kmovd	%k6, %eax
	testb	$2, %al
	je	.LBB0_21
	movl	$1, %eax
	lock		xaddl	%eax, (%rdx,%r13,4)
	vpinsrd	$1, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_21:
	kmovd	%k6, %eax
	testb	$4, %al
	je	.LBB0_23
	movl	$1, %eax
	lock		xaddl	%eax, (%rdx,%r13,4)
	vpinsrd	$2, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_23:
	kmovd	%k6, %eax
	testb	$8, %al
	je	.LBB0_25
	movl	$1, %eax
	lock		xaddl	%eax, (%rdx,%r13,4)
	vpinsrd	$3, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_25:
	kmovd	%k6, %eax
	testb	$16, %al
	je	.LBB0_27
	movl	$1, %eax
	movw	$16, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_27:
	kmovd	%k6, %eax
	testb	$32, %al
	je	.LBB0_29
	movl	$1, %eax
	movw	$32, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_29:
	kmovd	%k6, %eax
	testb	$64, %al
	je	.LBB0_31
	movl	$1, %eax
	movw	$64, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_31:
	kmovd	%k6, %eax
	testb	$-128, %al
	je	.LBB0_33
	movl	$1, %eax
	movw	$128, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_33:
	kmovd	%k6, %eax
	testl	$256, %eax
	je	.LBB0_35
	movl	$1, %eax
	movw	$256, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_35:
	kmovd	%k6, %eax
	testl	$512, %eax
	je	.LBB0_37
	movl	$1, %eax
	movw	$512, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_37:
	kmovd	%k6, %eax
	testl	$1024, %eax
	je	.LBB0_39
	movl	$1, %eax
	movw	$1024, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_39:
	kmovd	%k6, %eax
	testl	$2048, %eax
	je	.LBB0_41
	movl	$1, %eax
	movw	$2048, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_41:
	kmovd	%k6, %eax
	testl	$4096, %eax
	je	.LBB0_43
	movl	$1, %eax
	movw	$4096, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_43:
	kmovd	%k6, %eax
	testl	$8192, %eax
	je	.LBB0_45
	movl	$1, %eax
	movw	$8192, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_45:
	kmovd	%k6, %eax
	testl	$16384, %eax
	je	.LBB0_47
	movl	$1, %eax
	movw	$16384, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_47:
	kmovd	%k6, %eax
	testl	$32768, %eax
	je	.LBB0_49
	movl	$1, %eax
	movw	$-32768, %cx
	lock		xaddl	%eax, (%rdx,%r13,4)
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_49:
	vpaddd	%zmm2, %zmm2, %zmm1
	movq	136(%rsp), %rax
	kmovq	%k6, %k1
	kandw	%k5, %k2, %k2
	vpaddd	%zmm3, %zmm30, %zmm28
	vpaddd	%zmm1, %zmm2, %zmm1
	vpaddd	3712(%rsp), %zmm1, %zmm1
	vpslld	$16, %zmm4, %zmm2
	vpord	%zmm11, %zmm2, %zmm2
	vpscatterdd	%zmm2, (%rax,%zmm1,4) {%k1}
	kmovq	%k6, %k1
	vpscatterdd	%zmm13, 4(%rax,%zmm1,4) {%k1}
	vpaddd	%zmm3, %zmm31, %zmm13
	vpscatterdd	%zmm13, 8(%rax,%zmm1,4) {%k6}
	vaddps	%zmm18, %zmm29, %zmm1
	vmulps	(%rbx){1to16}, %zmm1, %zmm5
	kmovw	%k2, 80(%rsp)
	kmovw	72(%rsp), %k0
	kandnw	%k2, %k0, %k5
	vmovdqa32	%zmm7, %zmm1 {%k5} {z}
	vmovdqa32	%zmm26, %zmm2 {%k5} {z}
	vpminsd	%zmm2, %zmm1, %zmm11
	vmovdqa32	%zmm10, %zmm3 {%k5} {z}
	vpminsd	%zmm2, %zmm3, %zmm29
	kmovd	%k5, %eax
	vpsubd	%zmm6, %zmm11, %zmm1
	vpsubd	%zmm8, %zmm29, %zmm2
	vpmulld	%zmm1, %zmm2, %zmm30
	testb	$1, %al
	je	.LBB0_51
	vmovd	%xmm30, %r13d
	vmovd	%xmm28, %eax
	movl	%r13d, %edx
	testl	%r13d, %r13d
	leal	-2147483648(%rax), %ecx
	notl	%edx
	cmovel	%r14d, %r13d
	orl	%edx, %ecx
	cltd
	cmovel	%r14d, %r13d
	idivl	%r13d
	vmovd	%eax, %xmm2
.LBB0_51:
	kmovd	%k5, %eax
	testb	$2, %al
	je	.LBB0_53
	vpextrd	$1, %xmm30, %ecx
	vpextrd	$1, %xmm28, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	vpinsrd	$1, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_53:
	kmovd	%k5, %eax
	testb	$4, %al
	je	.LBB0_55
	vpextrd	$2, %xmm30, %ecx
	vpextrd	$2, %xmm28, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	vpinsrd	$2, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_55:
	kmovd	%k5, %eax
	testb	$8, %al
	je	.LBB0_57
	vpextrd	$3, %xmm30, %ecx
	vpextrd	$3, %xmm28, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	vpinsrd	$3, %eax, %xmm2, %xmm1
	vinserti32x4	$0, %xmm1, %zmm2, %zmm2
.LBB0_57:
	vextracti32x4	$1, %ymm28, %xmm1
	vextracti32x4	$1, %ymm30, %xmm3
	kmovd	%k5, %eax
	testb	$16, %al
	je	.LBB0_59
	vmovd	%xmm3, %ecx
	vmovd	%xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$16, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_59:
	kmovd	%k5, %eax
	testb	$32, %al
	je	.LBB0_61
	vpextrd	$1, %xmm3, %ecx
	vpextrd	$1, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$32, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_61:
	kmovd	%k5, %eax
	testb	$64, %al
	je	.LBB0_63
	vpextrd	$2, %xmm3, %ecx
	vpextrd	$2, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$64, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_63:
	kmovd	%k5, %eax
	testb	$-128, %al
	je	.LBB0_65
	vpextrd	$3, %xmm3, %ecx
	vpextrd	$3, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$128, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_65:
	vextracti32x4	$2, %zmm28, %xmm1
	vextracti32x4	$2, %zmm30, %xmm3
	kmovd	%k5, %eax
	testl	$256, %eax
	je	.LBB0_67
	vmovd	%xmm3, %ecx
	vmovd	%xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$256, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_67:
	kmovd	%k5, %eax
	testl	$512, %eax
	je	.LBB0_69
	vpextrd	$1, %xmm3, %ecx
	vpextrd	$1, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$512, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_69:
	kmovd	%k5, %eax
	testl	$1024, %eax
	je	.LBB0_71
	vpextrd	$2, %xmm3, %ecx
	vpextrd	$2, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$1024, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_71:
	kmovd	%k5, %eax
	testl	$2048, %eax
	je	.LBB0_73
	vpextrd	$3, %xmm3, %ecx
	vpextrd	$3, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$2048, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_73:
	vextracti32x4	$3, %zmm28, %xmm1
	vextracti32x4	$3, %zmm30, %xmm3
	kmovd	%k5, %eax
	testl	$4096, %eax
	je	.LBB0_75
	vmovd	%xmm3, %ecx
	vmovd	%xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$4096, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_75:
	kmovd	%k5, %eax
	testl	$8192, %eax
	je	.LBB0_77
	vpextrd	$1, %xmm3, %ecx
	vpextrd	$1, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$8192, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_77:
	kmovd	%k5, %eax
	testl	$16384, %eax
	je	.LBB0_79
	vpextrd	$2, %xmm3, %ecx
	vpextrd	$2, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$16384, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_79:
	kmovd	%k5, %eax
	testl	$32768, %eax
	je	.LBB0_81
	vpextrd	$3, %xmm3, %ecx
	vpextrd	$3, %xmm1, %eax
	movl	%ecx, %edx
	testl	%ecx, %ecx
	leal	-2147483648(%rax), %r13d
	notl	%edx
	cmovel	%r14d, %ecx
	orl	%edx, %r13d
	cltd
	cmovel	%r14d, %ecx
	idivl	%ecx
	movw	$-32768, %cx
	kmovd	%ecx, %k1
	vpbroadcastd	%eax, %zmm2 {%k1}
.LBB0_81:
	vpcmpgtd	%zmm8, %zmm29, %k1
	movabsq	$.LCPI0_16, %rcx
	movabsq	$.LCPI0_19, %rdx
	movabsq	$.LCPI0_7, %rax
	movabsq	$.LCPI0_9, %r13
	vpcmpgtd	%zmm6, %zmm11, %k1 {%k1}
	kandw	%k1, %k5, %k5
	kortestw	%k5, %k5
	je	.LBB0_89
	vpmulld	%zmm2, %zmm30, %zmm1
	vextracti64x4	$1, %zmm8, %ymm4
	vextracti64x4	$1, %zmm11, %ymm10
	vextracti64x4	$1, %zmm6, %ymm3
	vpmovsxdq	%ymm8, %zmm8
	vpmovsxdq	%ymm11, %zmm11
	vpmovsxdq	%ymm4, %zmm7
	vextracti64x4	$1, %zmm29, %ymm4
	vpmovsxdq	%ymm10, %zmm10
	vpmovsxdq	%ymm4, %zmm4
	vpsubd	%zmm1, %zmm28, %zmm12
	vpmovsxdq	%ymm3, %zmm1
	vpmovsxdq	%ymm6, %zmm3
	vpmovsxdq	%ymm29, %zmm6
	jmp	.LBB0_83
	.p2align	4
.LBB0_84:
	kxorw	%k0, %k0, %k2
	vpxor	%xmm14, %xmm14, %xmm14
	vpxor	%xmm8, %xmm8, %xmm8
	vpxor	%xmm7, %xmm7, %xmm7
.LBB0_88:
	kandnw	%k1, %k2, %k1
	vmovdqa64	%zmm14, %zmm12
	ktestw	%k5, %k1
	je	.LBB0_89
.LBB0_83:
	kandw	%k1, %k5, %k2
	kortestw	%k2, %k2
	je	.LBB0_84
	vpmullq	%zmm25, %zmm8, %zmm15
	vpmullq	%zmm25, %zmm7, %zmm18
	vpcmpeqb	%xmm0, %xmm0, %k6
	vmovdqa64	%zmm3, %zmm19
	vmovdqa64	%zmm1, %zmm20
	.p2align	4
.LBB0_86:
	vpcmpgtd	%zmm16, %zmm12, %k0
	kandw	%k6, %k2, %k3
	vpaddq	%zmm15, %zmm19, %zmm22
	vpaddq	%zmm18, %zmm20, %zmm21
	vpsubq	%zmm0, %zmm20, %zmm20
	vpsubq	%zmm0, %zmm19, %zmm19
	vpaddd	%zmm0, %zmm12, %zmm12
	vpmovm2d	%k0, %zmm23
	vpsubd	%zmm23, %zmm2, %zmm23
	kmovq	%k3, %k7
	kshiftrw	$8, %k3, %k4
	vpcmpneqq	%zmm11, %zmm19, %k0
	vmovdqa32	%zmm12, %zmm14 {%k6}
	vpslld	$7, %zmm23, %zmm23
	vscatterqps	%ymm17, (%r9,%zmm22,4) {%k7}
	kmovq	%k4, %k7
	vpaddd	%zmm9, %zmm23, %zmm23
	vscatterqps	%ymm17, (%r9,%zmm21,4) {%k7}
	vpscatterqd	%ymm23, (%r10,%zmm22,4) {%k3}
	vpcmpneqq	%zmm10, %zmm20, %k3
	vextracti64x4	$1, %zmm23, %ymm22
	kunpckbw	%k0, %k3, %k0
	vpscatterqd	%ymm22, (%r10,%zmm21,4) {%k4}
	kandw	%k0, %k6, %k6
	ktestw	%k2, %k6
	jne	.LBB0_86
	vpsubq	%zmm0, %zmm7, %zmm7
	vpsubq	%zmm0, %zmm8, %zmm8
	vpcmpeqq	%zmm6, %zmm8, %k0
	vpcmpeqq	%zmm4, %zmm7, %k2
	kunpckbw	%k0, %k2, %k2
	jmp	.LBB0_88
.Lfunc_end0:
	.size	beams, .Lfunc_end0-beams

	.type	float_const_signMask,@object
	.section	.lrodata,"al",@progbits
	.globl	float_const_signMask
	.p2align	2, 0x0
float_const_signMask:
	.long	2147483647
	.size	float_const_signMask, 4

	.type	magic_num_B,@object
	.globl	magic_num_B
	.p2align	4, 0x0
magic_num_B:
	.quad	6148914691236517205
	.quad	3689348814741910323
	.quad	1085102592571150095
	.quad	71777214294589695
	.quad	281470681808895
	.quad	4294967295
	.size	magic_num_B, 48

	.type	magic_num_S,@object
	.globl	magic_num_S
	.p2align	4, 0x0
magic_num_S:
	.long	1
	.long	2
	.long	4
	.long	8
	.long	16
	.long	32
	.size	magic_num_S, 24

	.ident	"Intel(R) oneAPI DPC++/C++ Compiler 2026.2.0 (2026.2.0.20261001)"
	.section	".note.GNU-stack","",@progbits
